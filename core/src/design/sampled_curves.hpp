// Curves by samples: where targets are as far from a smooth one as wanted, and places evenly along closed ones.
//
// Theory: docs/theory/synthesis-curves.md.
#pragma once

#include <cstdint>

#include "base/watch.hpp"
#include "motion/complex.hpp"

namespace gruebler::design {

using motion::Complex;

// A cubic polynomial of the arc between two samples.
struct SmoothCurve {
    const double* arcs;     // [samples] rising from 0; two samples at least
    const Complex* values;  // [samples, parts]
    const Complex* rates;   // [samples, parts] by the arc
    std::int64_t samples, parts;
    bool closed;  // the last sample is the first one; arcs wrap around
};

// Intervals of arcs, each with the target whose distance from the curve is looked at.
struct Brackets {
    const Complex* targets;        // [targets, parts]; NaN where a part is free
    const std::int64_t* target;    // [brackets]
    const double *low, *high;      // [brackets]
    const double* start;           // [brackets]
    const double* levels;          // [brackets] of half the squared distance, or null: where it does not change
    double rises;                  // 1 or -1: the sign at the upper ends of what vanishes
    std::int64_t count;
};

// The arcs in the brackets by Newton's method, halved where a step leaves its bracket. Cost: 0.3 us each.
bool settle_arcs(const SmoothCurve& curve, const Brackets& brackets, double* arcs, Watch& watch);

// The parameters, linear between samples, of so many places evenly along each closed curve; [curves, places]. The last sample of
// [curves, samples] is the first one; parameters are given at the samples.
bool spread_evenly(const Complex* z, const double* parameters, std::int64_t curves, std::int64_t samples, std::int64_t places,
                   double* spread, Watch& watch);

}  // namespace gruebler::design
