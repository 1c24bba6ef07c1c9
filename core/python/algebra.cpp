#include <complex>

#include "algebra/certificate.hpp"
#include "algebra/tracking.hpp"
#include "base/processor.hpp"
#include "doors.hpp"

namespace gruebler::doors {
namespace {

using namespace algebra;

using Number = std::complex<double>;
using Task = Array<Number, 4, 8>;
using Unknowns = Array<Number, -1, 8>;

struct LevelOfTracking {
    Level level;
    const char* name;
    Track* track;
    Refine* refine;
};

// The least level first.
constexpr LevelOfTracking levels[] = {
    {Level::baseline, "baseline", algebra::baseline::track, algebra::baseline::refine},
#ifdef GRUEBLER_X86_LEVELS
    {Level::v3, "v3", algebra::v3::track, algebra::v3::refine},
    {Level::v4, "v4", algebra::v4::track, algebra::v4::refine},
#endif
};

// The best level of this processor, or the one that is named.
const LevelOfTracking& level_of(const std::string& name) {
    const Level highest = highest_level();
    const LevelOfTracking* best = nullptr;
    for (const LevelOfTracking& each : levels) {
        if (each.level > highest) break;
        if (name.empty() || name == each.name) best = &each;
    }
    expect(best != nullptr, "this processor has no level " + name);
    return *best;
}

const double* parts(const Number* numbers) { return reinterpret_cast<const double*>(numbers); }

void check_shape(int positions, int points) {
    expect(positions >= 0 && positions <= 4 && points >= 0 && 2 * positions + points <= 8,
           "positions give two equations, points one: 0 to 8 of them");
}

nb::tuple track(const Unknowns& starts, const Task& begin, const Task& end, int positions, int points, double loose,
                const std::string& level) {
    check_shape(positions, points);
    expect(loose > 0, "loose must be positive");
    Track* kernel = level_of(level).track;
    const std::size_t count = starts.shape(0);
    std::vector<Number> ends(count * 8);
    std::vector<std::int64_t> status(count), steps(count);
    const Paths paths{positions, points, static_cast<std::int64_t>(count), parts(starts.data()), parts(begin.data()),
                      parts(end.data()), loose, reinterpret_cast<double*>(ends.data()), status.data(), steps.data()};
    run([&](Watch& watch) { return kernel(paths, watch); });
    return nb::make_tuple(hand_over<Number>(std::move(ends), {count, 8}),
                          hand_over<std::int64_t>(std::move(status), {count}),
                          hand_over<std::int64_t>(std::move(steps), {count}));
}

nb::tuple refine_solutions(const Unknowns& z, const Task& task, int positions, int points, const std::string& level) {
    check_shape(positions, points);
    Refine* kernel = level_of(level).refine;
    const std::size_t count = z.shape(0);
    std::vector<Number> refined(z.data(), z.data() + 8 * count);
    std::vector<double> last_steps(count);
    const Solutions solutions{positions, points, static_cast<std::int64_t>(count), parts(task.data()),
                              reinterpret_cast<double*>(refined.data()), last_steps.data()};
    run([&](Watch& watch) { return kernel(solutions, watch); });
    return nb::make_tuple(hand_over<Number>(std::move(refined), {count, 8}),
                          hand_over<double>(std::move(last_steps), {count}));
}

Candidates candidates(const Unknowns& z, const Task& task, int positions, int points) {
    check_shape(positions, points);
    return {positions, points, static_cast<std::int64_t>(z.shape(0)), parts(task.data()), parts(z.data()), nullptr};
}

NewArray<bool> certify(const Unknowns& z, const Task& task, int positions, int points) {
    Candidates all = candidates(z, task, positions, points);
    const std::size_t count = z.shape(0);
    std::vector<std::uint8_t> proved(count);
    all.proved = proved.data();
    run([&](Watch& watch) { return algebra::certify(all, watch); });
    return hand_over<bool>(std::move(proved), {count});
}

nb::tuple evaluate_equations(const Unknowns& z, const Task& task, int positions, int points, bool sharp) {
    const Candidates all = candidates(z, task, positions, points);
    const std::size_t count = z.shape(0);
    std::vector<Number> values(8 * count), derivatives(64 * count);
    algebra::evaluate_equations(all, sharp, reinterpret_cast<double*>(values.data()),
                                reinterpret_cast<double*>(derivatives.data()));
    return nb::make_tuple(hand_over<Number>(std::move(values), {count, 8}),
                          hand_over<Number>(std::move(derivatives), {count, 8, 8}));
}

}  // namespace

void add_algebra(nb::module_& module) {
    module.def("track", track, nb::arg("starts").noconvert(), nb::arg("begin").noconvert(), nb::arg("end").noconvert(),
               nb::arg("positions"), nb::arg("points"), nb::arg("loose"), nb::arg("level") = "",
               "Solutions of one task of four-bars followed to another, straight in the space of tasks: the ends "
               "complex[paths, 8], how each ended int64[paths] (0 arrived, 1 failed, 2 infinite), steps int64[paths]."
               "\n\n"
               "starts: complex[paths, 8], moving pivots x, x*, y, y*, fixed pivots a, a*, b, b*; begin, end: "
               "complex[4, 8], displacements t and their conjugates s of the positions, then of the points, turns g of "
               "the positions, values of the unknowns that no equation is left for; loose: how far the corrector may "
               "change a prediction; level: compiled for this instruction set, the best one by default.");
    module.def("refine_solutions", refine_solutions, nb::arg("z").noconvert(), nb::arg("task").noconvert(),
               nb::arg("positions"), nb::arg("points"), nb::arg("level") = "",
               "Newton's method for solutions of one task, with residuals of twice the digits: the solutions "
               "complex[n, 8] and the last relative step of each float64[n], infinite where the matrix is singular.\n\n"
               "The arguments are those of `track`.");
    module.def("certify", certify, nb::arg("z").noconvert(), nb::arg("task").noconvert(), nb::arg("positions"),
               nb::arg("points"),
               "Which solutions of one task are proved, each different from all others, by an interval Newton step: "
               "bool[n].\n\nThe arguments are those of `track`.");
    module.def("evaluate_equations", evaluate_equations, nb::arg("z").noconvert(), nb::arg("task").noconvert(),
               nb::arg("positions"), nb::arg("points"), nb::arg("sharp") = false,
               "The equations of one task at unknowns: their values complex[n, 8] and derivatives complex[n, 8, 8].\n\n"
               "sharp: values are computed with twice the digits; the other arguments are those of `track`.");
}

}  // namespace gruebler::doors
