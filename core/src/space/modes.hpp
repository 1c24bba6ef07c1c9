// Closed positions of linkages in space followed while the dimensions change, all of them complex numbers.
//
// The closing conditions of docs/theory/space.md; the paths of docs/theory/modes-in-space.md.
#pragma once

#include <cstdint>

#include "algebra/complex.hpp"
#include "base/watch.hpp"

namespace gruebler::space {

using algebra::Complex;

// What a node of the tree does: it stands still on its parent, which is a dimension; it turns, or shifts, along an axis.
enum class Kind : std::int64_t { still, turns, shifts };

// What a row asks: an offset along an axis of the first frame that is 0; an axis of the second frame at right angles to
// one of the first; a distance.
enum class RowKind : std::int64_t { offset, across, length };

inline constexpr int node_fields = 6, row_fields = 5, frame_size = 16, twist_size = 6, turn_size = 9;
inline constexpr int most_nodes = 512, most_unknowns = 64;  // more than linkages need; the dense Jacobian stays small

struct Structure {
    int nodes, rows, unknowns, balls;
    // [nodes, 6]: parent (one before, -1 for none), Kind, axis, sign, unknown (-1: its value is given), ball (-1: none).
    // At the first of the three turns of a ball stands where they are counted from.
    const std::int64_t* node;
    // [rows, 5]: RowKind, first and second node, axis, other axis.
    const std::int64_t* row;
};

// The way of the dimensions in a time from 0 to 1.
struct Way {
    const Complex* frames;   // [nodes, 4, 4] of a node that stands still, at the beginning
    const Complex* twists;   // [nodes, 6] turn, shift: at time t the frame is frames exp(t twists)
    const Complex* lengths;  // [2, rows] at the beginning, and their change
    const Complex* given;    // [2, nodes] values that are no unknowns, at the beginning, and their change
};

struct Paths {
    std::int64_t count;
    const Complex* starts;  // [count, unknowns]
    const Complex* turns;   // [count, balls, 3, 3] from where the turns of balls are counted
    double loose;           // how far the corrector may change a prediction: 1e-3 is quick; 1e-6 keeps near paths apart
    // Written:
    Complex* ends;
    Complex* end_turns;
    Complex* frames;      // [count, nodes, 4, 4] of all nodes where a path ended
    double* times;        // 1 where it arrived
    std::int64_t* steps;  // how many were tried
};

// False if the watch ends the work. Cost: some 10 us a step, 30 to 60 steps a path.
bool follow(const Structure& structure, const Way& way, const Paths& paths, Watch& watch);

}  // namespace gruebler::space
