// Layouts of points and segments in the plane: lowered energy, distances, crossings. Theory: docs/theory/drawing.md.
//
// A layout is points [n, 2]. Segments are pairs of points [m, 2]; watched pairs [k, 2] are (segment, point) whose
// distance must not vanish.
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"

namespace gruebler::layout {

struct Point {
    double x = 0, y = 0;
};

struct Segment {
    std::int64_t start, end;
};

struct Watched {
    std::int64_t segment, point;
};

// A turn or reflection of the plane.
struct Turn {
    double xx, xy, yx, yy;
};

struct Drawing {
    std::int64_t points, segments, watched;
    const Segment* segment;
    const double* pull;  // one for each segment
    const Watched* pair;
    std::int64_t symmetries;
    const std::int64_t* image;  // [symmetries, points]: symmetry g moves p to image[g, p] as the plane moves by turn[g]
    const Turn* turn;
};

// Lowers the energy, the sum of pull |segment|^2 and of distance^-power over the watched pairs, by steps so short that
// no watched point can pass its segment: descent with momentum; a step that raises the energy is taken back and
// shortened. The power is even. `done` is false if the watch ends the work. Cost: 15 ns a watched pair and round.
struct Relaxed {
    bool done;
    double energy;
};
Relaxed relax(const Drawing& drawing, int power, std::int64_t rounds, Point* layout, Watch& watch);

// The least distance of a watched pair, infinite if there is none.
double closest(const Drawing& drawing, const Point* layout);

// The pairs of segments without common point that cross: the smaller number first, in the order of the larger.
bool crossing_segments(const Drawing& drawing, const Point* layout, std::vector<Segment>& pairs, Watch& watch);

}  // namespace gruebler::layout
