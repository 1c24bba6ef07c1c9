// Free motion of one freedom, M q'' + h = Q with masses and forces as series of q. Theory: docs/theory/free-motion.md.
#pragma once

#include <array>
#include <cstdint>

namespace gruebler::dynamics {

// Mass M, slope h / q'^2, force and damping Q = force + q' damping, and of what has no potential the same two.
inline constexpr int quantities = 6;

// A piece of the axis of q: where it is used, and where its series lie in [-1, 1].
struct Piece {
    double low, high, middle, half;
};

// Pieces in increasing order, not always side by side.
struct Series {
    std::int64_t pieces, orders;
    const Piece* piece;
    const double* coefficient;  // [pieces, orders, quantities]: of Chebyshev polynomials
    double closed;              // a turn from this value of q leads back to the same pose; NaN if none does
};

struct Reduced {
    double mass, force, power;  // M, Q - h, and the power of what has no potential by q'
};

// At a value and speed of q; false where no piece lies. Cost: 0.1 to 0.2 us for 40 orders.
bool reduce(const Series& series, double q, double speed, Reduced& reduced);

// q, q' and the work of what has no potential.
inline constexpr int width = 3;
using State = std::array<double, width>;

// An explicit method of Runge and Kutta of order 8 with estimates of orders 5 and 3: its coefficients, as in scipy.
inline constexpr int stages = 12;
struct Method {
    const double* a;  // [stages, stages]
    const double* b;  // [stages]
    const double* e3;
    const double* e5;  // [stages + 1]
};

enum class Ended { stepped, outside, too_small };

struct Step {
    double time, length, next;  // where it ends, its length, and the one to try next
    State state;
    std::array<State, stages + 1> rates;  // of all stages, last of the new state
    std::int64_t evaluations;
};

// One step that keeps its error below absolute + relative |state|, by the rules of scipy's DOP853, at most to `until`.
// `outside` if a stage lies on no piece.
Ended step(const Series& series, const Method& method, double time, const State& state, const State& rate,
           double length, double until, double relative, const State& absolute, Step& taken);

}  // namespace gruebler::dynamics
