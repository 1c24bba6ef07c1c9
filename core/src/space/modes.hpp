// Closed positions of linkages in space followed while the dimensions change, all of them complex numbers.
//
// The closing conditions of docs/theory/space.md; the paths of docs/theory/modes-in-space.md.
#pragma once

#include <cstdint>

#include "base/watch.hpp"
#include "space/frames.hpp"

namespace gruebler::space {

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
