// The linear equations of a larger group without its bars: most of its bodies, and none of them has to be in a matrix.
#pragma once

#include <vector>

#include "motion/closure.hpp"

namespace gruebler::motion {

// A body that two pins and nothing else join to others. Three of its four equations give its three unknowns; the fourth says
// that the pins move alike along the bar.
struct Bar {
    int column = 0;                      // the first of its unknowns
    int row[2] = {none, none};           // the first equations of its pins
    double sign[2] = {0, 0};             // of its own place in them
};

// Bars of a group, no two of which are neighbours, and what there is besides.
struct Reduction {
    std::vector<Bar> bars;
    std::vector<int> rows, columns;  // the other equations and unknowns

    Reduction(const Condition* conditions, int count, int bodies);
};

// The linear equations of a step, for up to n unknowns.
struct LinearRoom {
    std::vector<double> residual;  // (n,)
    std::vector<double> jacobian;  // (n, n)
    std::vector<double> factors;   // (n, n) of what is solved: the Jacobian without bars, or the damped normal equations
    std::vector<double> solution;  // (n,) without bars, then of the bars
    std::vector<int> pivots;       // (n,) the row exchanges

    explicit LinearRoom(int n)
        : residual(n), jacobian(static_cast<std::size_t>(n) * n), factors(static_cast<std::size_t>(n) * n), solution(n),
          pivots(n) {}
};

// LU factors in place, with partial pivoting; returns the determinant.
double factor(double* matrix, int n, int* pivots);

// Solves in place with the factors of `factor`.
void solve_factored(const double* matrix, int n, const int* pivots, double* target);

// Factors the Jacobian of the room without bars and leaves it as it is. Returns the determinant of all of it but for a sign,
// which is one for all positions.
double factor(const Reduction& reduction, int n, LinearRoom& room);

// Solves all equations in place with these factors.
void solve_factored(const Reduction& reduction, int n, LinearRoom& room, double* target);

}  // namespace gruebler::motion
