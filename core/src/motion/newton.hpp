// Newton's method on closing conditions.
#pragma once

#include "motion/bars.hpp"
#include "motion/closure.hpp"

namespace gruebler::motion {

struct NewtonEnd {
    int steps;           // -1: no convergence
    double determinant;  // before the last step, as `factor` has it
};

// Changes the n unknowns in place; there are as many equations. It stops when a step is so small that the next would be below
// rounding (at a singular position, where steps only halve, the residual is).
NewtonEnd newton(const Conditions& conditions, const Reduction& reduction, double* x, int n, int steps, LinearRoom& room);

// Whether a position that Newton's method has left (arrived, or not, but with the conditions satisfied) is singular: of the
// Jacobian, its rows and angles scaled, a pivot vanishes but for what a position is off there, the root of rounding.
bool is_singular(const Conditions& conditions, const double* x, int n, bool has_arrived, LinearRoom& room);

// Closes a group near a singular position and leaves what its Jacobian does not hold as it is: damped Gauss-Newton steps, in
// which directions with a singular value below 1e-6 of the largest hardly change.
void close_near_singular(const Conditions& conditions, double* x, int n, LinearRoom& room);

}  // namespace gruebler::motion
