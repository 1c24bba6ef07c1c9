#include <cmath>
#include <complex>

#include "doors.hpp"
#include "space/following.hpp"
#include "space/modes.hpp"

namespace gruebler::doors {
namespace {

using namespace space;

using Number = std::complex<double>;

const algebra::Complex* parts(const Number* numbers) { return reinterpret_cast<const algebra::Complex*>(numbers); }
algebra::Complex* parts(std::vector<Number>& numbers) { return reinterpret_cast<algebra::Complex*>(numbers.data()); }

bool within(std::int64_t number, std::int64_t least, std::int64_t most) { return number >= least && number < most; }

// Each unknown belongs to one node, each ball to three nodes with unknowns in a row.
void check_nodes(const Array<std::int64_t, -1, node_fields>& nodes, std::int64_t unknowns, std::int64_t balls,
                 std::int64_t kinds) {
    const auto count = static_cast<std::int64_t>(nodes.shape(0));
    expect(within(count, 1, most_nodes + 1), "there are 1 to " + std::to_string(most_nodes) + " nodes");
    expect(unknowns <= most_unknowns, "there are at most " + std::to_string(most_unknowns) + " unknowns");
    std::vector<int> uses(static_cast<std::size_t>(unknowns)), starts(static_cast<std::size_t>(balls));
    for (std::int64_t k = 0; k < count; ++k) {
        const std::int64_t* own = nodes.data() + k * node_fields;
        const bool is_still = own[1] == static_cast<std::int64_t>(Kind::still);
        bool sound = within(own[0], -1, k) && within(own[1], 0, kinds) && within(own[2], 0, 3) && (own[3] == 1 || own[3] == -1) &&
                     within(own[4], -1, unknowns) && within(own[5], -1, balls) && (own[0] >= 0 || is_still) &&
                     !(is_still && (own[4] >= 0 || own[5] >= 0)) && (own[5] < 0 || (own[4] >= 0 && own[4] + 3 <= unknowns));
        if (sound && own[4] >= 0) sound = uses[static_cast<std::size_t>(own[4])]++ == 0;
        for (std::int64_t i = 1; sound && own[5] >= 0 && i < 3; ++i)  // its turns follow each other
            sound = k + i < count && own[i * node_fields + 1] == static_cast<std::int64_t>(Kind::turns) &&
                    own[i * node_fields + 4] == own[4] + i;
        if (sound && own[5] >= 0) sound = starts[static_cast<std::size_t>(own[5])]++ == 0;
        if (!sound) throw nb::value_error(("node " + std::to_string(k) + " is none").c_str());
    }
    for (const int use : uses) expect(use == 1, "each unknown belongs to a node");
    for (const int start : starts) expect(start == 1, "each ball begins at a node");
}

void check_rows(const Array<std::int64_t, -1, row_fields>& rows, std::int64_t nodes) {
    for (std::size_t r = 0; r < rows.shape(0); ++r) {
        const std::int64_t* own = rows.data() + r * row_fields;
        expect(within(own[0], 0, 3) && within(own[1], 0, nodes) && within(own[2], 0, nodes) && within(own[3], 0, 3) &&
                   within(own[4], 0, 3),
               "row " + std::to_string(r) + " is none");
    }
}

nb::tuple follow_modes(const Array<std::int64_t, -1, node_fields>& nodes, const Array<std::int64_t, -1, row_fields>& rows,
                       const Array<Number, -1, 4, 4>& frames, const Array<Number, -1, twist_size>& twists,
                       const Array<Number, 2, -1>& lengths, const Array<Number, 2, -1>& given,
                       const Array<Number, -1, -1>& starts, const Array<Number, -1, -1, 3, 3>& turns, double loose) {
    const std::size_t many = nodes.shape(0), count = starts.shape(0), unknowns = starts.shape(1), balls = turns.shape(1);
    expect(turns.shape(0) == count, "each path has its turns of balls");
    check_nodes(nodes, static_cast<std::int64_t>(unknowns), static_cast<std::int64_t>(balls), 3);
    check_rows(rows, static_cast<std::int64_t>(many));
    expect(rows.shape(0) == unknowns, "there are as many rows as unknowns");
    expect(frames.shape(0) == many && twists.shape(0) == many && given.shape(1) == many,
           "each node has a frame, a twist and a value");
    expect(lengths.shape(1) == unknowns, "each row has a length");
    expect(loose > 0, "loose must be positive");
    std::vector<Number> ends(count * unknowns), end_turns(count * balls * turn_size), places(count * many * frame_size);
    std::vector<double> times(count);
    std::vector<std::int64_t> steps(count);
    const Structure structure{static_cast<int>(many), static_cast<int>(unknowns), static_cast<int>(unknowns),
                              static_cast<int>(balls), nodes.data(), rows.data()};
    const Way way{parts(frames.data()), parts(twists.data()), parts(lengths.data()), parts(given.data())};
    const Paths paths{static_cast<std::int64_t>(count), parts(starts.data()), parts(turns.data()), loose, parts(ends),
                      parts(end_turns), parts(places), times.data(), steps.data()};
    run([&](Watch& watch) { return space::follow(structure, way, paths, watch); });
    return nb::make_tuple(hand_over<Number>(std::move(ends), {count, unknowns}),
                          hand_over<Number>(std::move(end_turns), {count, balls, 3, 3}),
                          hand_over<Number>(std::move(places), {count, many, 4, 4}),
                          hand_over<double>(std::move(times), {count}),
                          hand_over<std::int64_t>(std::move(steps), {count}));
}

using Nodes = Array<std::int64_t, -1, node_fields>;
using Rows = Array<std::int64_t, -1, row_fields>;

Linkage linkage_of(const Nodes& nodes, const Rows& rows, const Array<double, -1, 4, 4>& frames,
                   const Array<double, -1>& pitches, const Array<double, -1>& lengths, const Array<double, -1, -1>& gears,
                   std::size_t balls) {
    const std::size_t many = nodes.shape(0), unknowns = gears.shape(1);
    check_nodes(nodes, static_cast<std::int64_t>(unknowns), static_cast<std::int64_t>(balls), 4);
    check_rows(rows, static_cast<std::int64_t>(many));
    expect(frames.shape(0) == many && pitches.shape(0) == many, "each node has a frame and a pitch");
    expect(lengths.shape(0) == rows.shape(0), "each row has a length");
    const Structure structure{static_cast<int>(many),  static_cast<int>(rows.shape(0)), static_cast<int>(unknowns),
                              static_cast<int>(balls), nodes.data(),                    rows.data()};
    return {structure, frames.data(), pitches.data(), lengths.data(), gears.data(), static_cast<int>(gears.shape(0))};
}

void check_numbers(const Array<std::int64_t, -1>& numbers, std::int64_t least, std::size_t most, const char* what) {
    for (std::size_t k = 0; k < numbers.shape(0); ++k)
        expect(within(numbers.data()[k], least, static_cast<std::int64_t>(most)), what);
}

void check_rods(const Array<std::int64_t, -1, rod_fields>& rods, const Array<double, -1, rod_vectors, 3>& balls,
                std::size_t links) {
    expect(balls.shape(0) == rods.shape(0), "each rod has five vectors");
    for (std::size_t k = 0; k < rods.size(); ++k)
        expect(within(rods.data()[k], 0, static_cast<std::int64_t>(links)), "rods: the numbers of links");
}

void place_rods(const Array<std::int64_t, -1, rod_fields>& rods, const Array<double, -1, rod_vectors, 3>& balls,
                const Room<double, -1, -1, 4, 4>& poses) {
    const std::size_t links = poses.shape(1);
    check_rods(rods, balls, links);
    for (std::size_t row = 0; row < poses.shape(0); ++row)
        for (std::size_t k = 0; k < rods.shape(0); ++k) {
            const std::int64_t* own = rods.data() + k * rod_fields;
            const auto pose = [&](std::int64_t link) {
                return poses.data() + (row * links + static_cast<std::size_t>(link)) * frame_size;
            };
            const Frame<double> first = read_frame(pose(own[1])), second = read_frame(pose(own[2]));
            Frame<double> rod;
            place_rod(balls.data() + k * rod_vectors * 3, &first, &second, &rod, 0);
            write_frame(rod, pose(own[0]));
        }
}

nb::tuple open_linkage(const Nodes& nodes, const Rows& rows, const Array<double, -1, 4, 4>& frames,
                       const Array<double, -1>& pitches, const Array<double, -1>& lengths,
                       const Array<double, -1, -1>& gears, const Array<double, -1>& at, const Array<double, -1, 3, 3>& turns) {
    Conditions conditions(linkage_of(nodes, rows, frames, pitches, lengths, gears, turns.shape(0)));
    const std::size_t unknowns = gears.shape(1), count = conditions.values.size();
    expect(at.shape(0) == unknowns, "each unknown has a value");
    conditions.turns.assign(turns.data(), turns.data() + turns.size());
    conditions.evaluate(at.data());
    return nb::make_tuple(hand_over<double>(std::move(conditions.values), {count}),
                          hand_over<double>(std::move(conditions.derivatives), {count, unknowns}));
}

nb::tuple follow_linkage(const Nodes& nodes, const Rows& rows, const Array<double, -1, 4, 4>& frames,
                         const Array<double, -1>& pitches, const Array<double, -1>& lengths,
                         const Array<double, -1, -1>& gears, const Array<double, -1>& start,
                         const Array<double, -1, 3, 3>& turns, const Array<std::int64_t, -1>& passive,
                         const Array<std::int64_t, -1>& drives, const Array<std::int64_t, -1>& links,
                         const Array<std::int64_t, -1, rod_fields>& rods, const Array<double, -1, rod_vectors, 3>& balls_of_rods,
                         const Array<double, 4>& unit,
                         const Array<double, -1, -1>& values, const Array<double, -1, -1, -1>& rates) {
    const std::size_t unknowns = gears.shape(1), count = values.shape(0), orders = rates.shape(0);
    const std::size_t balls = turns.shape(0);
    expect(start.shape(0) == unknowns, "each unknown has a value at the start");
    const Linkage linkage = linkage_of(nodes, rows, frames, pitches, lengths, gears, balls);
    const std::size_t conditions = static_cast<std::size_t>(linkage.conditions()), passives = passive.shape(0);
    check_numbers(passive, 0, unknowns, "passive: the numbers of unknowns");
    check_numbers(drives, 0, unknowns, "drives: the numbers of unknowns");
    check_numbers(links, -1, nodes.shape(0), "links: the numbers of nodes, or -1");
    check_rods(rods, balls_of_rods, links.shape(0));
    expect(passives <= conditions, "there are no more passive unknowns than conditions");
    expect(orders <= static_cast<std::size_t>(most_orders), "there are rates up to the third order");
    expect(values.shape(1) == drives.shape(0) && rates.shape(1) == count && rates.shape(2) == drives.shape(0),
           "each row has a value and rates of each drive");
    const std::size_t each = values.shape(1);
    for (std::size_t k = 0; k < values.size(); ++k)
        expect(std::fabs(values.data()[k] - (k < each ? start.data()[drives.data()[k]] : values.data()[k - each])) <= longest_way,
               "values: no row lies farther than 1e9 from the one before");
    std::vector<double> found((orders + 1) * count * unknowns), derivatives(count * conditions * passives);
    std::vector<double> poses((orders + 1) * count * links.shape(0) * frame_size);
    std::vector<std::uint8_t> passed(count);
    Followed followed;
    const Path path{static_cast<std::int64_t>(count),      static_cast<int>(drives.shape(0)),
                    static_cast<int>(passives),            static_cast<int>(links.shape(0)),
                    static_cast<int>(rods.shape(0)),       static_cast<int>(orders),
                    drives.data(),                         passive.data(),
                    links.data(),                          rods.data(),
                    balls_of_rods.data(),                  unit.data(),
                    start.data(),                          turns.data(),
                    values.data(),                         rates.data(),
                    found.data(),                          poses.data(),
                    derivatives.data(),                    passed.data()};
    run([&](Watch& watch) { return space::follow(linkage, path, followed, watch); });
    return nb::make_tuple(hand_over<double>(std::move(found), {orders + 1, count, unknowns}),
                          hand_over<double>(std::move(poses), {orders + 1, count, links.shape(0), 4, 4}),
                          hand_over<double>(std::move(derivatives), {count, conditions, passives}),
                          hand_over<std::uint8_t>(std::move(passed), {count}), followed.rows, followed.part, followed.gap,
                          hand_over<double>(std::move(followed.place), {unknowns}),
                          hand_over<double>(std::move(followed.turns), {balls, 3, 3}));
}

}  // namespace

void add_space(nb::module_& module) {
    module.def("follow_modes", follow_modes, nb::arg("nodes").noconvert(), nb::arg("rows").noconvert(),
               nb::arg("frames").noconvert(), nb::arg("twists").noconvert(), nb::arg("lengths").noconvert(),
               nb::arg("given").noconvert(), nb::arg("starts").noconvert(), nb::arg("turns").noconvert(), nb::arg("loose"),
               "Closed positions followed while the dimensions change: ends complex[paths, unknowns], turns of balls "
               "complex[paths, balls, 3, 3], frames of all nodes complex[paths, nodes, 4, 4], times float[paths], 1 where "
               "a path arrived, steps int64[paths].\n\n"
               "nodes: int64[nodes, 6]: parent, 0 stands still, 1 turns, 2 shifts, axis, sign, unknown, ball; rows: "
               "int64[unknowns, 5]: 0 offset, 1 across, 2 length, first and second node, axis, other axis; frames: "
               "complex[nodes, 4, 4] at the beginning, twists: complex[nodes, 6] of their change; lengths: complex[2, "
               "unknowns] and given: complex[2, nodes], at the beginning and their change.");
    module.def("open_linkage", open_linkage, nb::arg("nodes").noconvert(), nb::arg("rows").noconvert(),
               nb::arg("frames").noconvert(), nb::arg("pitches").noconvert(), nb::arg("lengths").noconvert(),
               nb::arg("gears").noconvert(), nb::arg("at").noconvert(), nb::arg("turns").noconvert(),
               "By how much a linkage is open at a position, and the derivatives: float[conditions], float[conditions, "
               "unknowns].\n\nNodes, rows as for `follow_modes`, 3 also shifts by its pitch while it turns; gears: "
               "float[gears, unknowns], conditions behind those of the rows; turns: float[balls, 3, 3].");
    module.def("follow_linkage", follow_linkage, nb::arg("nodes").noconvert(), nb::arg("rows").noconvert(),
               nb::arg("frames").noconvert(), nb::arg("pitches").noconvert(), nb::arg("lengths").noconvert(),
               nb::arg("gears").noconvert(), nb::arg("start").noconvert(), nb::arg("turns").noconvert(),
               nb::arg("passive").noconvert(),
               nb::arg("drives").noconvert(), nb::arg("links").noconvert(), nb::arg("rods").noconvert(),
               nb::arg("balls_of_rods").noconvert(), nb::arg("unit").noconvert(), nb::arg("values").noconvert(),
               nb::arg("rates").noconvert(),
               "A linkage followed along values of its drives from a closed position: the unknowns as power series in "
               "time float[orders + 1, rows, unknowns], poses of links and their time derivatives float[orders + 1, rows, "
               "links, 4, 4], derivatives by the passive unknowns float[rows, conditions, passive], whether a change of "
               "mode was passed before a row uint8[rows], how many rows were reached, what part of the way to the next, by "
               "how much it is open at most, the last position float[unknowns] and its turns float[balls, 3, 3].\n\n"
               "passive, drives: int64, numbers of unknowns; links: int64, their nodes, -1 for rods; unit: "
               "float[4], the size of the linkage and its centre; values: float[rows, drives]; "
               "rates: float[orders, rows, drives], coefficients of t, t**2, t**3. The rest as for `open_linkage` "
               "and `place_rods`.");
    module.def("place_rods", place_rods, nb::arg("rods").noconvert(), nb::arg("balls").noconvert(),
               nb::arg("poses").noconvert(),
               "Writes the poses of rods between two balls into float[rows, links, 4, 4].\n\nrods: int64[rods, 3]: the rod, the "
               "links of its balls; balls: float[rods, 5, 3]: the balls on those links, the balls on the rod, across it.");
}

}  // namespace gruebler::doors
