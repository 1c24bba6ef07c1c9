#include <complex>

#include "design/crank_dyads.hpp"
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

Linkages linkages_of(const Drive& drive, const Dyads& dyads, const Elements& points, const Elements& lines,
                     const Table& sides, const Table& turned) {
    Linkages all{};
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
                      const Table& sides, const Table& turned) {
    const Linkages all = linkages_of(drive, dyads, points, lines, sides, turned);
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

}  // namespace

void add_design(nb::module_& module) {
    module.def("move_planes", move_planes, nb::arg("drive").noconvert(), nb::arg("dyads").noconvert(),
               nb::arg("points").noconvert(), nb::arg("lines").noconvert(), nb::arg("sides").noconvert(),
               nb::arg("turned").noconvert(),
               "How the planes of linkages of a crank and dyads move: a point w of a link goes to turn w + shift. Turns and "
               "shifts, complex128[links, linkages, angles]; NaN where a dyad cannot be assembled.\n\n"
               "drive: int64[4], frame, crank and the element of the pivot on each. dyads: int64[dyads, 11] in solving order: "
               "form (0 RRR, 1 RRP, 2 RPR, 3 PRP, 4 RPP), two links, their bases, then two elements on the bases, on the "
               "links at these, and on the links at the inner joint. points, lines: complex128[linkages, elements], lines of "
               "modulus 1, of size 0 where nothing slides. sides: float64[dyads, linkages]. turned: float64[linkages, angles].");
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
}

}  // namespace gruebler::doors
