#include <complex>

#include "doors.hpp"
#include "space/modes.hpp"

namespace gruebler::doors {
namespace {

using namespace space;

using Number = std::complex<double>;

const algebra::Complex* parts(const Number* numbers) { return reinterpret_cast<const algebra::Complex*>(numbers); }
algebra::Complex* parts(std::vector<Number>& numbers) { return reinterpret_cast<algebra::Complex*>(numbers.data()); }

bool within(std::int64_t number, std::int64_t least, std::int64_t most) { return number >= least && number < most; }

// Each unknown belongs to one node, each ball to three nodes with unknowns in a row.
void check_nodes(const Array<std::int64_t, -1, node_fields>& nodes, std::int64_t unknowns, std::int64_t balls) {
    const auto count = static_cast<std::int64_t>(nodes.shape(0));
    expect(within(count, 1, most_nodes + 1), "there are 1 to " + std::to_string(most_nodes) + " nodes");
    expect(unknowns <= most_unknowns, "there are at most " + std::to_string(most_unknowns) + " unknowns");
    std::vector<int> uses(static_cast<std::size_t>(unknowns)), starts(static_cast<std::size_t>(balls));
    for (std::int64_t k = 0; k < count; ++k) {
        const std::int64_t* own = nodes.data() + k * node_fields;
        const bool is_still = own[1] == static_cast<std::int64_t>(Kind::still);
        bool sound = within(own[0], -1, k) && within(own[1], 0, 3) && within(own[2], 0, 3) && (own[3] == 1 || own[3] == -1) &&
                     within(own[4], -1, unknowns) && within(own[5], -1, balls) && (own[0] >= 0 || is_still) &&
                     !(is_still && (own[4] >= 0 || own[5] >= 0)) && (own[5] < 0 || (own[4] >= 0 && own[4] + 3 <= unknowns));
        if (sound && own[4] >= 0) sound = uses[static_cast<std::size_t>(own[4])]++ == 0;
        if (sound && own[5] >= 0) sound = starts[static_cast<std::size_t>(own[5])]++ == 0;
        if (!sound) throw nb::value_error(("node " + std::to_string(k) + " is none").c_str());
    }
    for (const int use : uses) expect(use == 1, "each unknown belongs to a node");
    for (const int start : starts) expect(start == 1, "each ball begins at a node");
}

nb::tuple follow_modes(const Array<std::int64_t, -1, node_fields>& nodes, const Array<std::int64_t, -1, row_fields>& rows,
                       const Array<Number, -1, 4, 4>& frames, const Array<Number, -1, twist_size>& twists,
                       const Array<Number, 2, -1>& lengths, const Array<Number, 2, -1>& given,
                       const Array<Number, -1, -1>& starts, const Array<Number, -1, -1, 3, 3>& turns, double loose) {
    const std::size_t many = nodes.shape(0), count = starts.shape(0), unknowns = starts.shape(1), balls = turns.shape(1);
    expect(turns.shape(0) == count, "each path has its turns of balls");
    check_nodes(nodes, static_cast<std::int64_t>(unknowns), static_cast<std::int64_t>(balls));
    expect(rows.shape(0) == unknowns, "there are as many rows as unknowns");
    expect(frames.shape(0) == many && twists.shape(0) == many && given.shape(1) == many,
           "each node has a frame, a twist and a value");
    expect(lengths.shape(1) == unknowns, "each row has a length");
    for (std::size_t r = 0; r < unknowns; ++r) {
        const std::int64_t* own = rows.data() + r * row_fields;
        const auto last = static_cast<std::int64_t>(many);
        expect(within(own[0], 0, 3) && within(own[1], 0, last) && within(own[2], 0, last) && within(own[3], 0, 3) &&
                   within(own[4], 0, 3),
               "row " + std::to_string(r) + " is none");
    }
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
}

}  // namespace gruebler::doors
