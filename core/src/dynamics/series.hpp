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
inline constexpr int stages = 12, further_stages = 3, all_stages = stages + 1 + further_stages, bends = 4;
struct Method {
    const double* a;  // [stages, stages]
    const double* b;  // [stages]
    const double* e3;
    const double* e5;       // [stages + 1]
    const double* further;  // [further_stages, all_stages]: stages that only values within a step need
    const double* bend;     // [bends, all_stages]: the higher coefficients of a step's polynomial
};

enum class Ended { stepped, outside, too_small };

struct Step {
    double time, length, next;  // where it ends, its length, and the one to try next
    State state;
    std::array<State, all_stages> rates;  // of all stages, then of the new state; the further ones only where asked for
    std::int64_t evaluations;
};

// One step that keeps its error below absolute + relative |state|, by the rules of scipy's DOP853, at most to `until`.
// `outside` if a stage lies on no piece.
Ended step(const Series& series, const Method& method, double time, const State& state, const State& rate,
           double length, double until, double relative, const State& absolute, Step& taken);

// What a run of steps begins with, and where the last one left it.
struct Run {
    double time, length;  // of the step to try next
    State state, rate;
};

// On which piece a value lies, -1 if on none; the value less whole turns.
std::int64_t piece_at(const Series& series, double& q);

// The polynomials of a step; false where a further stage lies on no piece.
using Bend = std::array<State, 3 + bends>;
bool bent(const Series& series, const Method& method, const State& state, Step& taken, Bend& bend);
State within(const Bend& bend, const State& state, double part);  // of the step

// Many steps, at most `most`, to `until`: after each its end is told, and the state at each of the stops it passes,
// which are in order. Ends early after a step to a piece that is not calm (one flag each), and before one that leaves
// the pieces.
template <typename Ends, typename Stops>
void advance(const Series& series, const Method& method, const std::uint8_t* calm, Run& run, double until,
             double relative, const State& absolute, std::int64_t most, const double* stop, const double* last_stop,
             Ends&& ends, Stops&& stops) {
    Step taken;
    Bend bend;
    for (; most > 0 && run.time < until; --most) {
        const double begin = run.time;
        const State old = run.state;
        if (step(series, method, begin, old, run.rate, run.length, until, relative, absolute, taken) != Ended::stepped)
            return;
        const bool passes = stop != last_stop && *stop <= taken.time;
        if (passes && !bent(series, method, old, taken, bend)) return;
        run = {taken.time, taken.next, taken.state, taken.rates[stages]};
        for (; stop != last_stop && *stop <= taken.time; ++stop)
            stops(within(bend, old, (*stop - begin) / taken.length));
        ends(run, taken.evaluations);
        double q = run.state[0];
        const std::int64_t piece = piece_at(series, q);
        if (piece < 0 || !calm[piece]) return;
    }
}

}  // namespace gruebler::dynamics
