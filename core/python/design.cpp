#include <complex>

#include "base/processor.hpp"
#include "design/crank_dyads.hpp"
#include "design/limited_steps.hpp"
#include "design/pose_closing.hpp"
#include "design/sampled_curves.hpp"
#include "doors.hpp"

namespace gruebler::doors {
namespace {

using namespace design;

using Pair = std::complex<double>;  // what numpy stores as complex128; a `Complex` has its memory
static_assert(sizeof(Complex) == sizeof(Pair));

using Drive = Array<std::int64_t, 4>;
using Dyads = Array<std::int64_t, -1, 11>;
using Elements = Array<Pair, -1, -1>;
using Table = Array<double, -1, -1>;
using Numbers = Array<std::int64_t, -1>;

static_assert(sizeof(Crank) == 4 * sizeof(std::int64_t) && sizeof(CrankDyad) == 11 * sizeof(std::int64_t));

const Complex* complex_of(const Elements& elements) { return reinterpret_cast<const Complex*>(elements.data()); }

struct LevelOfLanes {
    Level level;
    const char* name;
    Lanes lanes;
};

// The least level first.
constexpr LevelOfLanes levels[] = {
    {Level::baseline, "baseline", {design::baseline::turn_crank, design::baseline::place_rrr}},
#ifdef GRUEBLER_X86_LEVELS
    {Level::v3, "v3", {design::v3::turn_crank, design::v3::place_rrr}},
    {Level::v4, "v4", {design::v4::turn_crank, design::v4::place_rrr}},
#endif
};

// The best level of this processor, or the one that is named.
Lanes lanes_of(const std::string& name) {
    const Level highest = highest_level();
    const Lanes* best = nullptr;
    for (const LevelOfLanes& each : levels) {
        if (each.level > highest) break;
        if (name.empty() || name == each.name) best = &each.lanes;
    }
    expect(best != nullptr, "this processor has no level " + name);
    return *best;
}

Linkages linkages_of(const Drive& drive, const Dyads& dyads, const Elements& points, const Elements& lines,
                     const Table& sides, const Table& turned, const std::string& level = "") {
    Linkages all{};
    all.lanes = lanes_of(level);
    all.crank = *reinterpret_cast<const Crank*>(drive.data());
    all.dyads = reinterpret_cast<const CrankDyad*>(dyads.data());
    all.dyad_count = static_cast<std::int64_t>(dyads.shape(0));
    all.link_count = 2 + 2 * all.dyad_count;
    all.count = static_cast<std::int64_t>(points.shape(0));
    all.element_count = static_cast<std::int64_t>(points.shape(1));
    all.angles = static_cast<std::int64_t>(turned.shape(1));
    expect(lines.size() == 0 || (lines.shape(0) == points.shape(0) && lines.shape(1) == points.shape(1)),
           "lines must be as many as points, or none");
    expect(sides.shape(0) == dyads.shape(0) && sides.shape(1) == points.shape(0),
           "sides must have a row for each dyad and a column for each linkage");
    expect(turned.shape(0) == points.shape(0), "turned must have a row for each linkage");
    all.points = complex_of(points);
    all.lines = lines.size() == 0 ? nullptr : complex_of(lines);
    all.sides = sides.data();
    all.turned = turned.data();
    const std::string message = fault(all);
    expect(message.empty(), message);
    return all;
}

// Slopes are told of drawings: turning joints, each of one place in the plane of all links.
void expect_drawings(const Linkages& all) {
    bool drawn = all.crank.on_frame == all.crank.on_link;
    for (std::int64_t d = 0; d < all.dyad_count; ++d) {
        const CrankDyad& dyad = all.dyads[d];
        drawn &= dyad.form == Form::rrr && dyad.inner[0] == dyad.inner[1];
        for (int k = 0; k < 2; ++k) drawn &= dyad.on_base[k] == dyad.on_link[k];
    }
    expect(drawn, "a drawing has turning joints, each of one place");
}

std::vector<std::int64_t> watched_of(const Numbers& watched, const Linkages& all) {
    for (std::size_t k = 0; k < watched.shape(0); ++k)
        expect(watched.data()[k] >= 0 && watched.data()[k] < all.dyad_count, "a watched dyad is none");
    return {watched.data(), watched.data() + watched.shape(0)};
}

void expect_tops(const std::vector<std::int64_t>& watched, const Linkages& all) {
    expect(all.angles == static_cast<std::int64_t>(2 * watched.size()), "turned must have two angles for each watched dyad");
}

nb::tuple move_planes(const Drive& drive, const Dyads& dyads, const Elements& points, const Elements& lines,
                      const Table& sides, const Table& turned, const std::string& level) {
    const Linkages all = linkages_of(drive, dyads, points, lines, sides, turned, level);
    const auto links = static_cast<std::size_t>(all.link_count), count = points.shape(0), angles = turned.shape(1);
    std::vector<Complex> turns(links * count * angles), shifts(turns.size());
    run([&](Watch& watch) { return design::move_planes(all, turns.data(), shifts.data(), watch); });
    return nb::make_tuple(hand_over<Pair>(std::move(turns), {links, count, angles}),
                          hand_over<Pair>(std::move(shifts), {links, count, angles}));
}

NewArray<double> find_tops(const Drive& drive, const Dyads& dyads, const Elements& points, const Elements& lines,
                           const Table& sides, const Table& turned, const Numbers& watched, bool between) {
    const Linkages all = linkages_of(drive, dyads, points, lines, sides, turned);
    const std::vector<std::int64_t> own = watched_of(watched, all);
    expect(all.angles > (between ? 1 : 0), "tops lie between two angles, or at one, at least");
    std::vector<double> tops(2 * own.size() * points.shape(0));
    run([&](Watch& watch) { return design::find_tops(all, own, between, tops.data(), watch); });
    return hand_over<double>(std::move(tops), {points.shape(0), 2 * own.size()});
}

NewArray<double> find_cosines(const Drive& drive, const Dyads& dyads, const Elements& points, const Elements& lines,
                              const Table& sides, const Table& turned, const Numbers& watched) {
    const Linkages all = linkages_of(drive, dyads, points, lines, sides, turned);
    const std::vector<std::int64_t> own = watched_of(watched, all);
    expect_tops(own, all);
    std::vector<double> cosines(2 * own.size() * points.shape(0));
    run([&](Watch& watch) { return design::find_cosines(all, own, cosines.data(), watch); });
    return hand_over<double>(std::move(cosines), {own.size(), 2, points.shape(0)});
}

NewArray<double> cosine_slopes(const Drive& drive, const Dyads& dyads, const Elements& places, const Table& sides,
                               const Table& turned, const Numbers& watched) {
    const Linkages all = linkages_of(drive, dyads, places, {}, sides, turned);
    expect_drawings(all);
    const std::vector<std::int64_t> own = watched_of(watched, all);
    expect_tops(own, all);
    const std::size_t numbers = 2 * places.shape(1);
    std::vector<double> slopes(2 * own.size() * numbers * places.shape(0));
    run([&](Watch& watch) { return design::cosine_slopes(all, own, slopes.data(), watch); });
    return hand_over<double>(std::move(slopes), {own.size(), 2, numbers, places.shape(0)});
}

void expect_link(std::int64_t link, const Linkages& all) {
    expect(link >= 0 && link < all.link_count, "the link of the point is none");
    expect(all.element_count > 0, "a linkage has a point");
}

NewArray<Pair> trace_point(const Drive& drive, const Dyads& dyads, const Elements& places, const Table& sides,
                           const Table& turned, std::int64_t link) {
    const Linkages all = linkages_of(drive, dyads, places, {}, sides, turned);
    expect_link(link, all);
    const std::size_t count = places.shape(0), angles = turned.shape(1);
    std::vector<Complex> z(count * angles);
    run([&](Watch& watch) { return trace(all, link, z.data(), watch); });
    return hand_over<Pair>(std::move(z), {count, angles});
}

nb::tuple trace_slopes(const Drive& drive, const Dyads& dyads, const Elements& places, const Table& sides,
                       const Table& turned, std::int64_t link, bool by_places) {
    const Linkages all = linkages_of(drive, dyads, places, {}, sides, turned);
    expect_drawings(all);
    expect_link(link, all);
    const std::size_t count = places.shape(0), angles = turned.shape(1);
    const std::size_t numbers = (by_places ? 2 * places.shape(1) : 0) + 1;
    std::vector<Complex> z(count * angles), slopes(numbers * z.size());
    run([&](Watch& watch) { return design::trace_slopes(all, link, by_places, z.data(), slopes.data(), watch); });
    return nb::make_tuple(hand_over<Pair>(std::move(z), {count, angles}),
                          hand_over<Pair>(std::move(slopes), {numbers, count, angles}));
}

using Joints = Array<std::int64_t, -1, 5>;
using Row = Array<double, -1>;
using Block = Array<double, -1, -1, -1>;

static_assert(sizeof(ClosedJoint) == 5 * sizeof(std::int64_t));

Closing closing_of(const Joints& joints, const Table& q, const Row& p, double size) {
    expect(q.shape(1) % 3 == 0, "q must have three numbers for each body");
    const Closing closing{reinterpret_cast<const ClosedJoint*>(joints.data()),
                          static_cast<std::int64_t>(joints.shape(0)),
                          static_cast<std::int64_t>(q.shape(1) / 3),
                          static_cast<std::int64_t>(p.shape(0)),
                          static_cast<std::int64_t>(q.shape(0)),
                          q.data(),
                          p.data(),
                          size};
    const std::string message = fault(closing);
    expect(message.empty(), message);
    return closing;
}

nb::tuple close_poses(const Joints& joints, const Table& q, const Row& p, double size, std::int64_t steps) {
    const Closing closing = closing_of(joints, q, p, size);
    std::vector<double> closed(q.size());
    std::vector<std::uint8_t> reached(q.shape(0));
    run([&](Watch& watch) { return design::close_poses(closing, steps, closed.data(), reached.data(), watch); });
    return nb::make_tuple(hand_over<double>(std::move(closed), {q.shape(0), q.shape(1)}),
                          hand_over<bool>(std::move(reached), {q.shape(0)}));
}

nb::tuple pose_slopes(const Joints& joints, const Table& q, const Row& p) {
    const Closing closing = closing_of(joints, q, p, 1.0);
    const auto equations = static_cast<std::size_t>(closing.equations());
    std::vector<double> by_pose(q.size() * equations), by_sizes(q.shape(0) * equations * p.shape(0));
    run([&](Watch& watch) { return design::pose_slopes(closing, by_pose.data(), by_sizes.data(), watch); });
    return nb::make_tuple(hand_over<double>(std::move(by_pose), {q.shape(0), equations, q.shape(1)}),
                          hand_over<double>(std::move(by_sizes), {q.shape(0), equations, p.shape(0)}));
}

NewArray<double> move_poses(const Joints& joints, const Table& q, const Row& p, double size) {
    const Closing closing = closing_of(joints, q, p, size);
    const auto freedoms = static_cast<std::size_t>(closing.freedoms());
    std::vector<double> motion(q.size() * freedoms);
    run([&](Watch& watch) { return design::move_poses(closing, motion.data(), watch); });
    return hand_over<double>(std::move(motion), {q.shape(0), q.shape(1), freedoms});
}

NewArray<double> pose_gradients(const Joints& joints, const Table& q, const Row& p, double size, const Block& by_pose) {
    const Closing closing = closing_of(joints, q, p, size);
    expect(by_pose.shape(0) == q.shape(0) && by_pose.shape(2) == q.shape(1),
           "by_pose must have a block for each pose and a column for each unknown");
    std::vector<double> gradients(q.shape(0) * by_pose.shape(1) * p.shape(0));
    const auto quantities = static_cast<std::int64_t>(by_pose.shape(1));
    run([&](Watch& watch) { return design::pose_gradients(closing, quantities, by_pose.data(), gradients.data(), watch); });
    return hand_over<double>(std::move(gradients), {q.shape(0), by_pose.shape(1), p.shape(0)});
}

NewArray<double> settle_arcs(const Row& arcs, const Elements& values, const Elements& rates, bool closed, const Elements& targets,
                             const Numbers& target, const Row& low, const Row& high, const Row& start, const Row& levels,
                             double rises) {
    const std::size_t count = target.shape(0);
    expect(arcs.shape(0) > 1 && values.shape(0) == arcs.shape(0) && rates.shape(0) == arcs.shape(0),
           "a curve has two samples or more, each with its value and rate");
    expect(rates.shape(1) == values.shape(1) && targets.shape(1) == values.shape(1), "targets have the parts of the curve");
    expect(low.shape(0) == count && high.shape(0) == count && start.shape(0) == count,
           "each bracket has two ends and a start");
    expect(levels.shape(0) == count || levels.shape(0) == 0, "levels must be as many as brackets, or none");
    for (std::size_t n = 0; n < count; ++n)
        expect(target.data()[n] >= 0 && target.data()[n] < static_cast<std::int64_t>(targets.shape(0)), "a target is none");
    const SmoothCurve curve{arcs.data(),
                            complex_of(values),
                            complex_of(rates),
                            static_cast<std::int64_t>(arcs.shape(0)),
                            static_cast<std::int64_t>(values.shape(1)),
                            closed};
    const Brackets brackets{complex_of(targets), target.data(), low.data(), high.data(), start.data(),
                            levels.shape(0) == count ? levels.data() : nullptr, rises, static_cast<std::int64_t>(count)};
    std::vector<double> settled(count);
    run([&](Watch& watch) { return design::settle_arcs(curve, brackets, settled.data(), watch); });
    return hand_over<double>(std::move(settled), {count});
}

NewArray<double> spread_evenly(const Elements& z, const Row& parameters, std::int64_t places) {
    expect(z.shape(1) > 1 && parameters.shape(0) == z.shape(1), "a curve has two samples or more, each with its parameter");
    expect(places >= 0, "places must not be negative");
    std::vector<double> spread(z.shape(0) * static_cast<std::size_t>(places));
    run([&](Watch& watch) {
        return design::spread_evenly(complex_of(z), parameters.data(), static_cast<std::int64_t>(z.shape(0)),
                                     static_cast<std::int64_t>(z.shape(1)), places, spread.data(), watch);
    });
    return hand_over<double>(std::move(spread), {z.shape(0), static_cast<std::size_t>(places)});
}

nb::tuple limit_steps(const Block& gram, const Table& step, const Table& values, const Block& slopes, double slack) {
    const std::size_t count = step.shape(0), numbers = step.shape(1);
    expect(gram.shape(0) == count && gram.shape(1) == numbers && gram.shape(2) == numbers,
           "gram must be square for each step");
    expect(values.shape(1) == count && slopes.shape(2) == count && slopes.shape(0) == values.shape(0),
           "each limit has a value and slopes for each step");
    expect(slopes.shape(1) <= numbers, "limits have no more unknowns than a step has numbers");
    const Steps steps{static_cast<std::int64_t>(count),
                      static_cast<std::int64_t>(numbers),
                      static_cast<std::int64_t>(values.shape(0)),
                      static_cast<std::int64_t>(slopes.shape(1)),
                      gram.data(),
                      step.data(),
                      values.data(),
                      slopes.data(),
                      slack};
    std::vector<double> limited(step.size());
    std::vector<std::uint8_t> changed(count);
    run([&](Watch& watch) { return design::limit_steps(steps, limited.data(), changed.data(), watch); });
    return nb::make_tuple(hand_over<double>(std::move(limited), {count, numbers}), hand_over<bool>(std::move(changed), {count}));
}

}  // namespace

void add_design(nb::module_& module) {
    module.def("move_planes", move_planes, nb::arg("drive").noconvert(), nb::arg("dyads").noconvert(),
               nb::arg("points").noconvert(), nb::arg("lines").noconvert(), nb::arg("sides").noconvert(),
               nb::arg("turned").noconvert(), nb::arg("level") = "",
               "How the planes of linkages of a crank and dyads move: a point w of a link goes to turn w + shift. Turns and "
               "shifts, complex128[links, linkages, angles]; NaN where a dyad cannot be assembled.\n\n"
               "drive: int64[4], frame, crank and the element of the pivot on each. dyads: int64[dyads, 11] in solving order: "
               "form (0 RRR, 1 RRP, 2 RPR, 3 PRP, 4 RPP), two links, their bases, then two elements on the bases, on the "
               "links at these, and on the links at the inner joint. points, lines: complex128[linkages, elements], lines of "
               "modulus 1, of size 0 where nothing slides. sides: float64[dyads, linkages]. turned: float64[linkages, angles].\n\n"
               "level: of the processor, as for `run_path`; the best by default.");
    module.def("find_tops", find_tops, nb::arg("drive").noconvert(), nb::arg("dyads").noconvert(),
               nb::arg("points").noconvert(), nb::arg("lines").noconvert(), nb::arg("sides").noconvert(),
               nb::arg("turned").noconvert(), nb::arg("watched").noconvert(), nb::arg("between"),
               "Where the cosine of each watched dyad is largest and least: float64[linkages, 2 watched]; between the angles, "
               "too, if these are a whole turn in equal steps.\n\n"
               "watched: int64[watched], numbers of dyads; the others as for `move_planes`.");
    module.def("find_cosines", find_cosines, nb::arg("drive").noconvert(), nb::arg("dyads").noconvert(),
               nb::arg("points").noconvert(), nb::arg("lines").noconvert(), nb::arg("sides").noconvert(),
               nb::arg("turned").noconvert(), nb::arg("watched").noconvert(),
               "The cosines of watched dyads at two angles each, beyond 1 where they cannot be assembled: float64[watched, 2, "
               "linkages].\n\nThe arguments are those of `find_tops`; turned: float64[linkages, 2 watched].");
    module.def("cosine_slopes", cosine_slopes, nb::arg("drive").noconvert(), nb::arg("dyads").noconvert(),
               nb::arg("places").noconvert(), nb::arg("sides").noconvert(), nb::arg("turned").noconvert(),
               nb::arg("watched").noconvert(),
               "How these change with x, y of each place, of turning joints drawn in one plane: float64[watched, 2, 2 places, "
               "linkages].\n\nplaces: complex128[linkages, places]; the others as for `find_cosines`.");
    module.def("trace_point", trace_point, nb::arg("drive").noconvert(), nb::arg("dyads").noconvert(),
               nb::arg("places").noconvert(), nb::arg("sides").noconvert(), nb::arg("turned").noconvert(),
               nb::arg("link"),
               "Where the last place goes with a link, NaN where any dyad cannot be assembled: complex128[linkages, angles].\n\n"
               "The arguments are those of `cosine_slopes`.");
    module.def("trace_slopes", trace_slopes, nb::arg("drive").noconvert(), nb::arg("dyads").noconvert(),
               nb::arg("places").noconvert(), nb::arg("sides").noconvert(), nb::arg("turned").noconvert(),
               nb::arg("link"), nb::arg("by_places"),
               "The same, and how it changes with x, y of each place, if wanted, and last with the crank: complex128[2 places + "
               "1 or 1, linkages, angles].");
    module.def("close_poses", close_poses, nb::arg("joints").noconvert(), nb::arg("q").noconvert(), nb::arg("p").noconvert(),
               nb::arg("size"), nb::arg("steps"),
               "The nearest closed poses of a linkage by Newton's method with least steps, float64[poses, unknowns], and which of "
               "them were reached, bool[poses].\n\n"
               "joints: int64[joints, 5]: two bodies, the frame after all others; which dimension is x of the joint on each, y and "
               "of a slide the angle of its line follow; 1 if it slides. q: float64[poses, 3 bodies], x, y, angle. p: "
               "float64[dimensions]. size: at this distance a point moves as far as its body turns.");
    module.def("pose_slopes", pose_slopes, nb::arg("joints").noconvert(), nb::arg("q").noconvert(), nb::arg("p").noconvert(),
               "How the closing conditions change with poses, float64[poses, equations, unknowns], and with the dimensions, "
               "float64[poses, equations, dimensions].\n\n"
               "The arguments are those of `close_poses`; two equations for each joint.");
    module.def("move_poses", move_poses, nb::arg("joints").noconvert(), nb::arg("q").noconvert(), nb::arg("p").noconvert(),
               nb::arg("size"),
               "How poses move while no dimension changes: float64[poses, unknowns, freedoms].\n\n"
               "The arguments are those of `close_poses`.");
    module.def("pose_gradients", pose_gradients, nb::arg("joints").noconvert(), nb::arg("q").noconvert(), nb::arg("p").noconvert(),
               nb::arg("size"), nb::arg("by_pose").noconvert(),
               "How quantities of poses change with the dimensions while the poses do not move along their freedom: "
               "float64[poses, quantities, dimensions].\n\n"
               "by_pose: float64[poses, quantities, unknowns]; the others as for `close_poses`.");
    module.def("settle_arcs", settle_arcs, nb::arg("arcs").noconvert(), nb::arg("values").noconvert(),
               nb::arg("rates").noconvert(), nb::arg("closed"), nb::arg("targets").noconvert(), nb::arg("target").noconvert(),
               nb::arg("low").noconvert(), nb::arg("high").noconvert(), nb::arg("start").noconvert(),
               nb::arg("levels").noconvert(), nb::arg("rises"),
               "Where in brackets half the squared distance of a target from a curve has a level, or, without levels, does not "
               "change: float64[brackets], arcs.\n\n"
               "arcs: float64[samples]; values, rates: complex128[samples, parts], rates by the arc. targets: complex128[targets, "
               "parts], NaN where free. target: int64[brackets]. low, high, start: float64[brackets]. levels: float64[brackets or "
               "0]. rises: 1 or -1, the sign at the upper ends.");
    module.def("spread_evenly", spread_evenly, nb::arg("z").noconvert(), nb::arg("parameters").noconvert(), nb::arg("places"),
               "The parameters of so many places evenly along closed curves: float64[curves, places].\n\n"
               "z: complex128[curves, samples], the last sample is the first one. parameters: float64[samples].");
    module.def("limit_steps", limit_steps, nb::arg("gram").noconvert(), nb::arg("step").noconvert(),
               nb::arg("values").noconvert(), nb::arg("slopes").noconvert(), nb::arg("slack"),
               "Steps changed, at least cost, to the nearest within linear limits, float64[steps, numbers], and which lay beyond "
               "one, bool[steps].\n\n"
               "gram: float64[steps, numbers, numbers]. step: float64[steps, numbers]. values: float64[limits, steps]. slopes: "
               "float64[limits, unknowns, steps]; unknowns are the first numbers. slack: so far beyond a limit counts as within.");
}

}  // namespace gruebler::doors
