// Rows of drive values, and what is written for them.
#pragma once

#include <cstdint>

#include "motion/complex.hpp"

namespace gruebler::motion {

// Rows of drive values and their time derivatives.
struct Path {
    const double* values;  // (rows, drives)
    const double* speeds;  // (orders, rows, drives)
    std::int64_t rows;
    int drives, orders;
    double least = 1e-14;  // the smallest step, in rows: so exactly a limit is found
};

// A column for each row of the path.
struct Poses {
    Complex* places;      // (order + 1, links, rows)
    Complex* turns;       // (links, rows)
    double* rates;        // (order, links, rows)
    std::int32_t* whole;  // (links, rows) whole turns since the first row, for angles without jumps
    double* roots;        // (dyads, rows) signed roots
    double* unknowns;     // (unknowns, rows) of larger groups
    int order, links, dyads, unknown_count;
    std::int64_t rows;
};

namespace {

inline double drive(const Path& path, std::int64_t row, int d) { return path.values[row * path.drives + d]; }

inline double speed(const Path& path, int k, std::int64_t row, int d) {
    return path.speeds[(k * path.rows + row) * path.drives + d];
}

// The row at a place on the path, or the last one before it.
inline std::int64_t row_at(const Path& path, double at) {
    const std::int64_t last = path.rows - 1;
    return at < static_cast<double>(last) ? (at > 0 ? static_cast<std::int64_t>(at) : 0) : at >= 0 ? last : 0;
}

inline Complex* turns_of(const Poses& poses, int link) { return poses.turns + link * poses.rows; }
inline std::int32_t* whole_of(const Poses& poses, int link) { return poses.whole + link * poses.rows; }
inline double* roots_of(const Poses& poses, int dyad) { return poses.roots + dyad * poses.rows; }

inline Complex* places_of(const Poses& poses, int k, int link) {
    return poses.places + (static_cast<std::int64_t>(k) * poses.links + link) * poses.rows;
}

inline double* rates_of(const Poses& poses, int k, int link) {
    return poses.rates + (static_cast<std::int64_t>(k) * poses.links + link) * poses.rows;
}

// What a whole turn changes by from one pose to the next: the negative x axis is crossed upwards or downwards.
inline int crossed(Complex now, Complex last) {
    const double height = now.y < 0 ? -now.y : now.y, before = last.y < 0 ? -last.y : last.y;
    const bool sides = (now.y < 0) != (last.y < 0), behind = last.x * height + now.x * before < 0;
    return static_cast<int>(sides) & static_cast<int>(behind) ? (now.y < 0 ? 1 : -1) : 0;
}

// Whether the drives go on to a row as they came, not back and not much faster: then the past predicts.
inline bool steady(const Path& path, std::int64_t row) {
    constexpr double faster = 1.5;  // times the last change of a drive: after a larger one the past predicts nothing
    if (row < 2) return false;
    bool moved = false;
    for (int d = 0; d < path.drives; ++d) {
        const double change = drive(path, row, d) - drive(path, row - 1, d);
        const double past = drive(path, row - 1, d) - drive(path, row - 2, d);
        const double way = change < 0 ? -change : change, before = past < 0 ? -past : past;
        if (change * past < 0 || way > faster * before) return false;
        moved |= change != 0;
    }
    return moved;
}

}  // namespace
}  // namespace gruebler::motion
