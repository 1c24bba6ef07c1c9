// Solutions followed from one task of four-bars to another, and sharpened.
//
// Parameter homotopy: Hermite predicts from the last places and slopes, Newton corrects. Theory:
// docs/theory/synthesis-points.md.
#pragma once

#include <cstdint>

#include "base/level.hpp"
#include "base/watch.hpp"

namespace gruebler::algebra {

// Arrays of complex numbers are pairs of doubles: a task [4, 8], solutions [count, 8]; ten instead of eight of six-bars
// through eleven pairs and of those that guide a body, of these fourteen if no pivot is given. A task has so many positions
// besides the first, two equations each, and points, one equation each; the rest of the eight fix unknowns of those
// numbers.

// Whose equations they are: of four-bars through positions and points, or of six-bars whose input and output turn through
// pairs of angles, each an equation (`points`: 7, 8 or 10); six_bar_system.hpp; or of six-bars that carry a body through
// `positions` besides the first; six_bar_guidance.hpp.
enum class Family : int { four_bars, watt_2, stephenson_2, stephenson_3, watt_1, watt_1_free };

// How a path ended: at a finite solution; steps too small or too many; growing without bound.
enum class PathEnd : std::int64_t { arrived, failed, infinite };

struct Paths {
    Family family;
    int positions, points;
    std::int64_t count;
    const double* starts;
    const double* begin;
    const double* end;
    double loose;  // how far the corrector may change a prediction: 1e-3 is quick; 1e-6 keeps near paths apart
    double* ends;          // written: where each ended
    std::int64_t* status;  // written: PathEnd
    std::int64_t* steps;   // written: how many were tried
};

struct Solutions {
    Family family;
    int positions, points;
    std::int64_t count;
    const double* task;
    double* z;           // changed
    double* last_steps;  // written: relative; infinite where the matrix is singular
};

// False if the watch ends the work. Cost: 3 us a step, 230 steps a path.
using Track = bool(const Paths& paths, Watch& watch);

// Newton's method, with residuals of twice the digits: of ill-conditioned solutions near by, too.
using Refine = bool(const Solutions& solutions, Watch& watch);

namespace baseline {
Track track;
Refine refine;
}  // namespace baseline
namespace v3 {
Track track;
Refine refine;
}  // namespace v3
namespace v4 {
Track track;
Refine refine;
}  // namespace v4

}  // namespace gruebler::algebra
