#include "motion/designs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gruebler::motion {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class Number>
void copy_rows(const Number* from, Number* to, std::int64_t reached, std::int64_t rows, Number unknown) {
    std::copy(from, from + reached, to);
    std::fill(to + reached, to + rows, unknown);
}

// The motion of one design, before the links that are kept are written.
struct OwnPoses {
    std::vector<Complex> places, turns;
    std::vector<double> rates, roots, unknowns;
    std::vector<std::int32_t> whole;

    OwnPoses(const Program& program, int order, std::int64_t rows)
        : places((order + 1) * program.link_count * rows), turns(program.link_count * rows),
          rates(order * program.link_count * rows), roots(program.dyad_count * rows),
          unknowns(program.unknown_count * rows), whole(program.link_count * rows) {}

    Poses view(const Program& program, int order, std::int64_t rows) {
        return {places.data(), turns.data(), rates.data(), whole.data(), roots.data(), unknowns.data(), order,
                static_cast<int>(program.link_count), static_cast<int>(program.dyad_count),
                static_cast<int>(program.unknown_count), rows};
    }
};

void write(const Poses& poses, const DesignPoses& out, std::int64_t design, std::int64_t reached) {
    constexpr Complex nowhere{not_a_number, not_a_number};
    const std::int64_t rows = poses.rows;
    out.reached[design] = reached;
    for (std::int64_t m = 0; m < out.kept_count; ++m) {
        const int link = static_cast<int>(out.kept[m]);
        const auto at = [&](std::int64_t k) { return ((k * out.designs + design) * out.kept_count + m) * rows; };
        copy_rows(turns_of(poses, link), out.turns + at(0), reached, rows, nowhere);
        for (int k = 0; k <= out.order; ++k)
            copy_rows(places_of(poses, k, link), out.places + at(k), reached, rows, nowhere);
        for (int k = 0; k < out.order; ++k)
            copy_rows(rates_of(poses, k, link), out.rates + at(k), reached, rows, not_a_number);
    }
}

}  // namespace

bool move_designs(const Program& program, OwnPlan& plan, const Path& path, const Designs& designs,
                  const DesignPoses& out, std::int64_t first, std::int64_t last, Sweep* sweep, Watch& watch) {
    OwnPoses own(program, out.order, path.rows);
    const Poses poses = own.view(program, out.order, path.rows);
    Walk walk(plan.view(program), path, poses, sweep);
    for (std::int64_t n = first; n < last; ++n) {
        plan.set_elements(designs.points + n * program.element_count, designs.lines + n * program.element_count);
        walk.set_design(designs.most + n * program.drive_count, designs.sizes[n]);
        const double* signs = designs.signs + n * program.dyad_count;
        std::int64_t reached = 0;
        if (std::none_of(signs, signs + program.dyad_count, [](double sign) { return std::isnan(sign); })) {
            const Outcome outcome = walk.follow(signs, designs.starts + n * program.unknown_count, watch);
            if (outcome.end == End::interrupted) return false;
            reached = outcome.reached;
        }
        write(poses, out, n, reached);
    }
    return true;
}

}  // namespace gruebler::motion
