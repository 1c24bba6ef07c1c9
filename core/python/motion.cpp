#include <nanobind/stl/pair.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/processor.hpp"
#include "doors.hpp"
#include "motion/designs.hpp"
#include "motion/newton.hpp"
#include "motion/tracing.hpp"
#include "motion/walk.hpp"

namespace gruebler::doors {
namespace {

using namespace motion;

using Pair = std::complex<double>;  // what numpy stores as complex128; a `Complex` has its memory
static_assert(sizeof(Complex) == sizeof(Pair));

const Complex* complex_of(const Pair* data) { return reinterpret_cast<const Complex*>(data); }
Complex* complex_of(Pair* data) { return reinterpret_cast<Complex*>(data); }

std::int64_t length(std::size_t n) { return static_cast<std::int64_t>(n); }

// The arrays of a tuple by their names, one after another.
class Fields {
public:
    Fields(const char* whole, const nb::tuple& tuple, std::size_t count) : whole_(whole), tuple_(tuple) {
        expect(tuple.size() == count, std::string(whole) + " has " + std::to_string(count) + " fields");
    }

    template <class Field>
    Field next(const char* name) {
        Field field;
        if (!nb::try_cast(tuple_[at_++], field, false))
            throw nb::type_error((std::string(whole_) + "." + name + " is not of the right kind and shape").c_str());
        return field;
    }

    double number(const char* name) {
        double value = 0;
        if (!nb::try_cast(tuple_[at_++], value, true))
            throw nb::type_error((std::string(whole_) + "." + name + " is not a number").c_str());
        return value;
    }

private:
    const char* whole_;
    const nb::tuple& tuple_;
    std::size_t at_ = 0;
};

void expect_length(std::size_t found, std::int64_t wanted, const char* name) {
    expect(length(found) == wanted, std::string(name) + " must have the length " + std::to_string(wanted));
}

using Indices = Array<std::int64_t, -1>;
using Reals = Array<double, -1>;
using Table = Array<double, -1, -1>;
using Complexes = Array<Pair, -1>;

constexpr std::int64_t counted = -1;

std::int64_t largest(const Indices& numbers) {
    std::int64_t most = 0;
    for (std::size_t i = 0; i < numbers.shape(0); ++i) most = std::max(most, numbers.data()[i]);
    return most;
}

// A program as it was given, and the plan that was read from it.
struct OwnProgram {
    Array<std::int64_t, -1, 10> operations;
    Indices links, conditions, kinds, sides, owners, bodies, roots, windings;
    Complexes points, lines;
    Reals most;
    Array<double, -1, 6> values;
    Table pieces;
    Program rows;
    OwnPlan plan;

    // `link_count` may be `counted` from the links that are named.
    OwnProgram(const nb::tuple& tuple, std::int64_t link_count, std::int64_t dyad_count, std::int64_t unknown_count) {
        Fields fields("program", tuple, 15);
        operations = fields.next<Array<std::int64_t, -1, 10>>("operations");
        links = fields.next<Indices>("links");
        points = fields.next<Complexes>("points");
        lines = fields.next<Complexes>("lines");
        conditions = fields.next<Indices>("conditions");
        kinds = fields.next<Indices>("kinds");
        sides = fields.next<Indices>("sides");
        owners = fields.next<Indices>("owners");
        bodies = fields.next<Indices>("bodies");
        roots = fields.next<Indices>("roots");
        most = fields.next<Reals>("most");
        const double size = fields.number("size");
        values = fields.next<Array<double, -1, 6>>("values");
        windings = fields.next<Indices>("windings");
        pieces = fields.next<Table>("pieces");
        const std::int64_t elements = length(links.shape(0)), count = length(kinds.shape(0));
        if (link_count == counted) {
            const std::int64_t last = std::max(largest(links), largest(roots));
            link_count = last < std::numeric_limits<std::int64_t>::max() ? last + 1 : last;  // then it is refused
        }
        expect_length(points.shape(0), elements, "program.points");
        expect_length(lines.shape(0), elements, "program.lines");
        expect_length(sides.shape(0), 2 * count, "program.sides");
        expect_length(owners.shape(0), 2 * count, "program.owners");
        expect_length(values.shape(0), count, "program.values");
        expect_length(windings.shape(0), count, "program.windings");
        expect(conditions.shape(0) >= 1, "program.conditions is not empty");
        expect_length(bodies.shape(0), length(conditions.shape(0)), "program.bodies");
        expect(pieces.shape(1) >= 2 || pieces.shape(0) == 0, "a piece of a law has a middle and a width");
        rows = {operations.data(), links.data(), complex_of(points.data()), complex_of(lines.data()), conditions.data(),
                kinds.data(), sides.data(), owners.data(), bodies.data(), roots.data(), most.data(), values.data(),
                windings.data(), {pieces.data(), length(pieces.shape(0)), length(pieces.shape(1))}, size,
                length(operations.shape(0)), elements, link_count, length(most.shape(0)), dyad_count,
                length(conditions.shape(0)) - 1, count, length(roots.shape(0)), unknown_count};
        const std::string wrong = read_plan(rows, plan);
        expect(wrong.empty(), "program: " + wrong);
    }
};

Path path_of(const Table& path, const Array<double, -1, -1, -1>& speeds, std::int64_t drives, std::int64_t order) {
    expect(path.shape(0) >= 1, "a path has at least one row");
    expect_length(path.shape(1), drives, "a row of the path");
    expect(speeds.shape(1) == path.shape(0) && speeds.shape(2) == path.shape(1),
           "speeds must have the shape (order, rows, drives)");
    expect(length(speeds.shape(0)) >= order && speeds.shape(0) <= most_orders,
           "there are speeds for the order, and for three at most");
    const double* values = path.data();
    bool finite = true;
    for (std::size_t i = 0, count = path.size(); i < count; ++i) finite &= std::isfinite(values[i]);
    expect(finite, "drive values are finite");
    return {values, speeds.data(), length(path.shape(0)), static_cast<int>(drives),
            static_cast<int>(speeds.shape(0))};
}

struct LevelOfSweep {
    Level level;
    const char* name;
    Sweep* sweep;
};

// The least level first.
constexpr LevelOfSweep levels[] = {
    {Level::baseline, "baseline", motion::baseline::sweep},
#ifdef GRUEBLER_X86_LEVELS
    {Level::v3, "v3", motion::v3::sweep},
    {Level::v4, "v4", motion::v4::sweep},
#endif
};

// The best level of this processor, or the one that is named.
Sweep* sweep_of(const std::string& name) {
    const Level highest = highest_level();
    Sweep* best = nullptr;
    for (const LevelOfSweep& each : levels) {
        if (each.level > highest) break;
        if (name.empty() || name == each.name) best = each.sweep;
    }
    expect(best != nullptr, "this processor has no level " + name);
    return best;
}

nb::tuple run_path(const nb::tuple& program, const Table& path, const Array<double, -1, -1, -1>& speeds,
                   const Reals& signs, const Reals& start, const nb::tuple& poses, const std::string& level) {
    Fields fields("poses", poses, 6);
    const auto places = fields.next<Room<Pair, -1, -1, -1>>("places");
    const auto turns = fields.next<Room<Pair, -1, -1>>("turns");
    const auto rates = fields.next<Room<double, -1, -1, -1>>("rates");
    const auto whole = fields.next<Room<std::int32_t, -1, -1>>("whole");
    const auto roots = fields.next<Room<double, -1, -1>>("roots");
    const auto unknowns = fields.next<Room<double, -1, -1>>("unknowns");
    const std::size_t order = rates.shape(0), links = turns.shape(0), rows = path.shape(0);
    expect(order <= most_orders, "the order is 0 to 3");
    const auto fits = [rows](const auto& array, std::size_t first) {
        return array.shape(array.ndim() - 1) == rows && array.shape(0) == first;
    };
    expect(fits(places, order + 1) && places.shape(1) == links && fits(turns, links) && fits(rates, order) &&
               rates.shape(1) == links && fits(whole, links) && fits(roots, signs.shape(0)) &&
               fits(unknowns, start.shape(0)),
           "the arrays of the poses have not the shapes of one motion");
    const OwnProgram own(program, length(links), length(signs.shape(0)), length(start.shape(0)));
    const Path along = path_of(path, speeds, own.rows.drive_count, length(order));
    const Poses out{complex_of(places.data()), complex_of(turns.data()), rates.data(), whole.data(), roots.data(),
                    unknowns.data(), static_cast<int>(order), static_cast<int>(links),
                    static_cast<int>(signs.shape(0)), static_cast<int>(start.shape(0)), length(rows)};
    Walk walk(own.plan.view(own.rows), along, out, sweep_of(level));
    const Outcome outcome = run([&](Watch& watch) { return walk.follow(signs.data(), start.data(), watch); });
    return nb::make_tuple(static_cast<int>(outcome.end), outcome.reached, outcome.at, outcome.fault);
}

void run_designs(const nb::tuple& program, const nb::tuple& designs, const Table& path,
                 const Array<double, -1, -1, -1>& speeds, const Indices& kept, const nb::tuple& poses,
                 const std::pair<std::int64_t, std::int64_t>& part, const std::string& level) {
    Fields inputs("designs", designs, 6);
    const auto points = inputs.next<Array<Pair, -1, -1>>("points");
    const auto lines = inputs.next<Array<Pair, -1, -1>>("lines");
    const auto most = inputs.next<Table>("most");
    const auto sizes = inputs.next<Reals>("sizes");
    const auto signs = inputs.next<Table>("signs");
    const auto starts = inputs.next<Table>("starts");
    Fields fields("poses", poses, 4);
    const auto places = fields.next<Room<Pair, -1, -1, -1, -1>>("places");
    const auto turns = fields.next<Room<Pair, -1, -1, -1>>("turns");
    const auto rates = fields.next<Room<double, -1, -1, -1, -1>>("rates");
    const auto reached = fields.next<Room<std::int64_t, -1>>("reached");
    const std::size_t count = sizes.shape(0), order = rates.shape(0), rows = path.shape(0), links = kept.shape(0);
    const auto fits = [&](const auto& array) {
        const std::size_t last = array.ndim() - 1;
        return array.shape(last - 2) == count && array.shape(last - 1) == links && array.shape(last) == rows;
    };
    expect(order <= most_orders && places.shape(0) == order + 1 && fits(places) && fits(turns) && fits(rates) &&
               reached.shape(0) == count,
           "the arrays of the poses have not the shapes of these designs");
    OwnProgram own(program, counted, length(signs.shape(1)), length(starts.shape(1)));
    for (std::size_t m = 0; m < links; ++m)
        expect(kept.data()[m] >= 0 && kept.data()[m] < own.rows.link_count, "a kept link is not there");
    const auto has = [&](const auto& array, std::int64_t width) {
        return array.shape(0) == count && length(array.shape(1)) == width;
    };
    expect(has(points, own.rows.element_count) && has(lines, own.rows.element_count) &&
               has(most, own.rows.drive_count) && signs.shape(0) == count && starts.shape(0) == count,
           "the arrays of the designs have not the shapes of the program");
    expect(0 <= part.first && part.first <= part.second && part.second <= length(count),
           "the part is not one of these designs");
    const Path along = path_of(path, speeds, own.rows.drive_count, length(order));
    const Designs in{complex_of(points.data()), complex_of(lines.data()), most.data(), sizes.data(), signs.data(),
                     starts.data()};
    const DesignPoses out{complex_of(places.data()), complex_of(turns.data()), rates.data(), reached.data(),
                          kept.data(), length(count), length(links), static_cast<int>(order)};
    Sweep* sweep = sweep_of(level);
    run([&](Watch& watch) {
        return move_designs(own.rows, own.plan, along, in, out, part.first, part.second, sweep, watch);
    });
}

// Closing conditions as they were given, read; for bodies of so many unknowns.
struct OwnConditions {
    std::vector<Condition> list;
    std::vector<ElementJet> sides;
    Table pieces;
    Conditions view;
    int equation_count = 0;

    OwnConditions(const nb::tuple& tuple, std::size_t unknowns) {
        Fields fields("conditions", tuple, 8);
        const auto kinds = fields.next<Indices>("kinds");
        const auto values = fields.next<Array<double, -1, 8>>("values");
        pieces = fields.next<Table>("pieces");
        const auto owners = fields.next<Indices>("owners");
        const auto points = fields.next<Array<Pair, -1, -1>>("points");
        const auto lines = fields.next<Complexes>("lines");
        fields.next<Table>("spins");
        const double size = fields.number("size");
        const std::int64_t count = length(kinds.shape(0));
        expect(unknowns % 3 == 0, "each body has three unknowns");
        expect(unknowns <= most_unknowns, "there are too many unknowns");
        expect_length(values.shape(0), count, "conditions.values");
        expect_length(owners.shape(0), 2 * count, "conditions.owners");
        expect_length(points.shape(0), 2 * count, "conditions.points");
        expect_length(lines.shape(0), 2 * count, "conditions.lines");
        expect(points.shape(1) >= 1, "conditions.points holds the points themselves");
        expect(pieces.shape(1) >= 2 || pieces.shape(0) == 0, "a piece of a law has a middle and a width");
        const Laws laws{pieces.data(), length(pieces.shape(0)), length(pieces.shape(1))};
        list.resize(count);
        sides.resize(2 * count);
        for (std::int64_t c = 0; c < count; ++c) {
            const std::string wrong = read_condition(kinds.data()[c], values.data() + 8 * c, owners.data()[2 * c],
                                                     owners.data()[2 * c + 1], length(unknowns) / 3, laws, list[c]);
            expect(wrong.empty(), "condition " + std::to_string(c) + " " + wrong);
            equation_count += equations(list[c].kind);
        }
        for (std::int64_t e = 0; e < 2 * count; ++e) {
            sides[e].point[0] = complex_of(points.data())[e * length(points.shape(1))];
            sides[e].line = complex_of(lines.data())[e];
        }
        view = {list.data(), sides.data(), static_cast<int>(count), laws, size};
    }

private:
    static constexpr std::size_t most_unknowns = 20000;  // their Jacobian has 3 GB
};

double closing_door(const nb::tuple& conditions, const Reals& x, const Room<double, -1>& residual,
                    const Room<double, -1, -1>& jacobian) {
    const OwnConditions own(conditions, x.shape(0));
    const auto equations = static_cast<std::size_t>(own.equation_count);
    expect(residual.shape(0) >= equations, "the residual has a number for each equation");
    expect(jacobian.shape(0) >= equations && jacobian.shape(1) == x.shape(0),
           "the Jacobian has a row for each equation and a column for each unknown");
    return closing(own.view, x.data(), static_cast<int>(x.shape(0)), residual.data(), jacobian.data());
}

nb::tuple newton_door(const nb::tuple& conditions, const Room<double, -1>& x, int steps) {
    const OwnConditions own(conditions, x.shape(0));
    const int n = static_cast<int>(x.shape(0));
    expect(own.equation_count == n, "Newton's method needs as many equations as unknowns");
    LinearRoom room(n);
    const NewtonEnd end = newton(own.view, {own.list.data(), own.view.count, n / 3}, x.data(), n, steps, room);
    return nb::make_tuple(end.steps, end.determinant);
}

void close_near_singular_door(const nb::tuple& conditions, const Room<double, -1>& x) {
    const OwnConditions own(conditions, x.shape(0));
    const int n = static_cast<int>(x.shape(0));
    expect(own.equation_count == n && n > 0, "there are as many equations as unknowns");
    LinearRoom room(n);
    close_near_singular(own.view, x.data(), n, room);
}

nb::tuple jacobian_door(const nb::tuple& conditions, const Reals& x) {
    const OwnConditions own(conditions, x.shape(0));
    const std::size_t m = own.equation_count, n = x.shape(0);
    std::vector<double> residual(m), jacobian(m * n);
    closing(own.view, x.data(), static_cast<int>(n), residual.data(), jacobian.data());
    return nb::make_tuple(hand_over<double>(std::move(residual), {m}), hand_over<double>(std::move(jacobian), {m, n}));
}

nb::tuple settle_on_curve(const nb::tuple& conditions, const Room<double, -1>& x, const Room<double, -1>& tangent) {
    const OwnConditions own(conditions, x.shape(0));
    expect_length(tangent.shape(0), length(x.shape(0)), "the tangent");
    Tracing tracing(own.view, static_cast<int>(x.shape(0)));
    const Settled there = tracing.settle(x.data(), tangent.data());
    const auto rank = static_cast<std::size_t>(there.rank);
    std::vector<std::int64_t> rows(tracing.order().begin(), tracing.order().begin() + there.rank);
    return nb::make_tuple(there.arrived, there.open, there.gauge, there.rank,
                          hand_over<std::int64_t>(std::move(rows), {rank}));
}

// Samples of a curve; the arrays are written.
Samples samples_of(const nb::tuple& curve, std::size_t unknowns, bool with_gauges) {
    Fields fields("samples", curve, 4);
    const auto arcs = fields.next<Room<double, -1>>("arcs");
    const auto poses = fields.next<Room<double, -1, -1>>("poses");
    const auto tangents = fields.next<Room<double, -1, -1>>("tangents");
    const auto gauges = fields.next<Room<double, -1>>("gauges");
    const std::size_t room = arcs.shape(0);
    const auto fits = [&](const auto& array) { return array.shape(0) == room && array.shape(1) == unknowns; };
    expect(fits(poses) && fits(tangents) && (!with_gauges || gauges.shape(0) == room),
           "the arrays of the samples have not the shapes of one curve");
    return {arcs.data(), poses.data(), tangents.data(), gauges.data(), length(room)};
}

std::size_t unknowns_of(const nb::tuple& curve) {
    expect(curve.size() == 4, "samples has 4 fields");
    Array<double, -1, -1> poses;
    if (!nb::try_cast(curve[1], poses, false)) throw nb::type_error("samples.poses is not of the right kind and shape");
    return poses.shape(1);
}

nb::tuple trace_curve(const nb::tuple& conditions, const nb::tuple& curve, std::int64_t count, double step,
                      double longest, double most) {
    const std::size_t n = unknowns_of(curve);
    const OwnConditions own(conditions, n);
    const Samples samples = samples_of(curve, n, true);
    expect(count >= 1 && count <= samples.room, "there is a first sample, and no more than there is room for");
    expect(std::isfinite(step) && std::isfinite(longest), "steps are finite");
    Tracing tracing(own.view, static_cast<int>(n));
    const Trace trace =
        run([&](Watch& watch) { return tracing.follow(samples, count, step, longest, most, watch); });
    return nb::make_tuple(static_cast<int>(trace.end), trace.count, trace.step);
}

std::int64_t evaluate_pose(const nb::tuple& conditions, const nb::tuple& curve, const Reals& at,
                           const Indices& segments, const Room<double, -1, -1>& poses,
                           const Room<double, -1, -1>& tangents) {
    const std::size_t n = unknowns_of(curve), count = at.shape(0);
    const OwnConditions own(conditions, n);
    const Samples samples = samples_of(curve, n, false);
    expect_length(segments.shape(0), length(count), "segments");
    expect(poses.shape(0) == count && poses.shape(1) == n && tangents.shape(0) == count && tangents.shape(1) == n,
           "poses and tangents have a row for each place");
    for (std::size_t i = 0; i < count; ++i)
        expect(segments.data()[i] >= 0 && segments.data()[i] < samples.room - 1, "a segment lies between two samples");
    Tracing tracing(own.view, static_cast<int>(n));
    return run([&](Watch& watch) {
        return tracing.evaluate(samples, at.data(), segments.data(), length(count), poses.data(), tangents.data(),
                                watch);
    });
}

}  // namespace

void add_motion(nb::module_& module) {
    module.def("run_path", run_path, nb::arg("program"), nb::arg("path").noconvert(), nb::arg("speeds").noconvert(),
               nb::arg("signs").noconvert(), nb::arg("start").noconvert(), nb::arg("poses"), nb::kw_only(),
               nb::arg("level") = "",
               "Moves a linkage along rows of drive values. Returns how it ended (0: at the last row, 1: at a limit, 2: at a "
               "singular place, 3: at the first row), how many rows are written, where on the path it stopped (in rows), "
               "and what is at fault: the number of the dyad, or -1 minus that of the larger group.\n\n"
               "program: the fields of Program. path: float64[rows, drives]; speeds: float64[order, rows, drives], their "
               "time derivatives. signs: float64[dyads] of the assembly modes at the first row; start: float64[unknowns] "
               "of larger groups there. poses: the fields of PoseBuffer, written. level: for tests, one of "
               "level_names().");
    module.def("run_designs", run_designs, nb::arg("program"), nb::arg("designs"), nb::arg("path").noconvert(),
               nb::arg("speeds").noconvert(), nb::arg("kept").noconvert(), nb::arg("poses"), nb::arg("part"),
               nb::kw_only(), nb::arg("level") = "",
               "Moves designs of one program one after another, from the first of the part to the one before its last.\n\n"
               "designs: the fields of DesignInputs. kept: int64[kept], the links that are written. poses: the fields of "
               "DesignPoses, written.");
    module.def("closing", closing_door, nb::arg("conditions"), nb::arg("x").noconvert(),
               nb::arg("residual").noconvert(), nb::arg("jacobian").noconvert(),
               "Writes residual and Jacobian of closing conditions at x (x, y and angle of each body); returns the "
               "largest residual.\n\n"
               "conditions: the fields of Conditions.");
    module.def("newton", newton_door, nb::arg("conditions"), nb::arg("x").noconvert(), nb::arg("steps"),
               "Newton's method on as many equations as unknowns, in place. Returns how often it stepped (-1: no "
               "convergence) and the determinant.");
    module.def("close_near_singular", close_near_singular_door, nb::arg("conditions"), nb::arg("x").noconvert(),
               "Closes a group near a singular position, in place, and leaves what its Jacobian does not hold as it is.");
    module.def("jacobian", jacobian_door, nb::arg("conditions"), nb::arg("x").noconvert(),
               "Residual float64[m] and Jacobian float64[m, n] of closing conditions.");
    module.def("settle_on_curve", settle_on_curve, nb::arg("conditions"), nb::arg("x").noconvert(),
               nb::arg("tangent").noconvert(),
               "Puts a pose on the curve, by the nearest way, and a direction along it, in place. Returns whether it "
               "arrived, how far the joints are open, the gauge, the rank of the Jacobian, and int64[rank]: the equations "
               "on which the others depend, if one is redundant.");
    module.def("trace_curve", trace_curve, nb::arg("conditions"), nb::arg("samples"), nb::arg("count"),
               nb::arg("step"), nb::arg("longest"), nb::arg("most"),
               "Follows the curve of all positions from the last of so many samples until something happens. Returns what "
               "(0: back at the start, 1: no room, 2: longest length, 3: no step succeeds, 4: the determinant changes its "
               "sign behind the last sample), how many samples there are now, and the step.\n\n"
               "samples: the fields of SampleBuffer, written.");
    module.def("evaluate_pose", evaluate_pose, nb::arg("conditions"), nb::arg("samples"), nb::arg("at").noconvert(),
               nb::arg("segments").noconvert(), nb::arg("poses").noconvert(), nb::arg("tangents").noconvert(),
               "Poses and tangents at given lengths, each between samples k and k + 1; returns how many were found.");
}

}  // namespace gruebler::doors
