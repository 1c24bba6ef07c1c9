// Newton's method on closing conditions, and the linear equations that it needs.
#pragma once

#include <vector>

#include "motion/closure.hpp"

namespace gruebler::motion {

// The linear equations of a step, for up to n unknowns.
struct LinearRoom {
    std::vector<double> residual;  // (n,)
    std::vector<double> jacobian;  // (n, n)
    std::vector<double> normal;    // (n, n) of the damped normal equations
    std::vector<int> pivots;       // (n,) the row exchanges of `factor`

    explicit LinearRoom(int n)
        : residual(n), jacobian(static_cast<std::size_t>(n) * n), normal(static_cast<std::size_t>(n) * n), pivots(n) {}
};

// LU factors in place, with partial pivoting; returns the determinant.
double factor(double* matrix, int n, int* pivots);

// Solves in place with the factors of `factor`.
void solve_factored(const double* matrix, int n, const int* pivots, double* target);

struct NewtonEnd {
    int steps;  // -1: no convergence
    double determinant;
};

// Changes the n unknowns in place; there are as many equations. It stops when a step is so small that the next would be below
// rounding (at a singular position, where steps only halve, the residual is). The Jacobian is left factored as it was before
// the last step.
NewtonEnd newton(const Conditions& conditions, double* x, int n, int steps, LinearRoom& room);

// Whether a position that Newton's method has left (arrived, or not, but with the conditions satisfied) is singular: of the
// Jacobian, its rows and angles scaled, a pivot vanishes but for what a position is off there, the root of rounding.
bool is_singular(const Conditions& conditions, const double* x, int n, bool has_arrived, LinearRoom& room);

// Closes a group near a singular position and leaves what its Jacobian does not hold as it is: damped Gauss-Newton steps, in
// which directions with a singular value below 1e-6 of the largest hardly change.
void close_near_singular(const Conditions& conditions, double* x, int n, LinearRoom& room);

}  // namespace gruebler::motion
