// The proof that a solution is one: an interval Newton step.
//
// Krawczyk's operator K(Z) = z - Y f(z) + (1 - Y J(Z)) (Z - z), with Y near the inverse of the Jacobian at z, maps a
// box Z of discs about z into its interior only if there is exactly one solution in it. Source: R. Krawczyk, Computing
// 4 (1969) 187-201. Theory: docs/theory/synthesis-points.md.
#pragma once

#include <cstdint>

#include "base/watch.hpp"

namespace gruebler::algebra {

// Solutions of one task, in the form of tracking.hpp.
struct Candidates {
    int positions, points;
    std::int64_t count;
    const double* task;
    const double* z;
    std::uint8_t* proved;  // written: 1 where it is proved to be a solution, different from all others
};

// False if the watch ends the work. Cost: 20 us a solution.
bool certify(const Candidates& candidates, Watch& watch);

// The equations at each candidate: their values complex[8] in double precision or with twice the digits, and the
// derivatives complex[8, 8] in double precision.
void evaluate_equations(const Candidates& candidates, bool sharp, double* values, double* derivatives);

}  // namespace gruebler::algebra
