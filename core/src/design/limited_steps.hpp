// Steps of an optimisation changed to the nearest ones within linear limits, many at once.
#pragma once

#include <cstdint>

#include "base/watch.hpp"

namespace gruebler::design {

struct Steps {
    std::int64_t count, numbers;      // steps, and the numbers of each
    std::int64_t limits, unknowns;    // the first numbers are limited
    const double* gram;               // [steps, numbers, numbers] what a change of a step costs; positive definite
    const double* step;               // [steps, numbers]
    const double* values;             // [limits, steps] without any step; not positive within a limit
    const double* slopes;             // [limits, unknowns, steps]
    double slack;                     // so much beyond a limit counts as within
};

// The steps of least cost of their change; one stays as it is if there is none within all limits. `changed`: whether it lay
// beyond one. A problem of least distance, solved by least squares that are not negative: Lawson and Hanson, Solving Least
// Squares Problems, chapter 23. Cost: 2 to 30 us for each that is changed.
bool limit_steps(const Steps& steps, double* step, std::uint8_t* changed, Watch& watch);

}  // namespace gruebler::design
