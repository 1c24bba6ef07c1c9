// The curve of all positions of a linkage with one freedom, followed by pseudo-arclength continuation.
//
// The unknowns are x, y and angle of each body, lengths in units of the linkage's size; no drive is imposed. Rows of the Jacobian
// are orthonormalised, the longest remaining row first, so that a row that depends on others (a redundant constraint, or one
// that is lost at a change point) is seen by its length and left out. docs/theory/circuits.md has the theorems and tolerances.
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"
#include "motion/closure.hpp"

namespace gruebler::motion {

// Samples of n unknowns, as many as there is room for.
struct Samples {
    double* arcs;      // (room,) length from the first one
    double* poses;     // (room, n)
    double* tangents;  // (room, n) of length 1
    double* gauges;    // (room,) the shortest independent row, with the sign of the bordered determinant if none is redundant
    std::int64_t room;
};

// How a trace ended: back at the start; no room for more samples; at the longest length; no step succeeds; the bordered
// determinant has changed its sign from the last sample to the one behind it, which is not counted yet.
enum class TraceEnd : int { closed, full, too_long, lost, flip, interrupted };

struct Trace {
    TraceEnd end;
    std::int64_t count;  // of samples
    double step;
};

// A pose that was put on the curve: whether it arrived, how far the joints are open, the gauge and the rank there.
struct Settled {
    bool arrived;
    double open, gauge;
    int rank;
};

// The memory of one call.
class Tracing {
public:
    Tracing(const Conditions& conditions, int unknowns);

    // Puts a pose on the curve, by the nearest way, and a direction along it; both are changed in place.
    Settled settle(double* x, double* tangent);

    // The equations from which the last orthonormal rows were made, if `settle` has found a redundant one.
    const std::vector<int>& order() const { return order_; }

    // Follows the curve from the last of `count` samples until something happens. `longest` bounds a step, `most` the length.
    Trace follow(const Samples& samples, std::int64_t count, double step, double longest, double most, Watch& watch);

    // Poses and tangents at given lengths, each between samples k and k + 1; returns how many were found. A cubic through both
    // samples predicts the pose; Newton's method puts it on the curve in the plane across the chord.
    std::int64_t evaluate(const Samples& samples, const double* at, const std::int64_t* segments, std::int64_t count,
                          double* poses, double* tangents, Watch& watch);

private:
    struct Attempt {
        bool good, back;
    };

    struct Tangent {
        double open, gauge;
        int rank;
    };

    const Conditions conditions_;
    const int n_, m_;
    std::vector<double> residual_;  // (rows,)
    std::vector<double> rows_;      // (rows, n) the Jacobian, and the normal of a plane
    std::vector<double> work_;      // (rows, n) what is left of the rows after the basis is taken off
    std::vector<double> shares_;    // (rows, n) of the basis in each row
    std::vector<double> basis_;     // (n, n) orthonormal rows
    std::vector<int> order_;        // (rows,) from which row each of the basis was made
    std::vector<char> free_;        // (rows,) whether a row has none in the basis yet
    std::vector<double> trial_;     // (n,) a pose
    std::vector<double> normal_;    // (n,) the normal of a plane, or the start as it is seen from a pose
    std::vector<double> lengths_;   // (rows,) squared, of what is left of the rows
    std::int64_t reduced_ = 0;      // how often rows were made orthonormal

    int reduce(int count, int first);
    bool correct(double* x, const double* normal, double level);
    Tangent set_tangent(const double* x, double* tangent);
    bool start_ahead(const Samples& samples, std::int64_t k, double step);
    Attempt attempt(const Samples& samples, std::int64_t k, double step);
    bool go_on(Watch& watch);
};

}  // namespace gruebler::motion
