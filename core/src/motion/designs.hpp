// Many designs of one mechanism moved along one path.
#pragma once

#include <cstdint>

#include "motion/walk.hpp"

namespace gruebler::motion {

// In what designs of one program differ.
struct Designs {
    const Complex* points;  // (designs, elements)
    const Complex* lines;   // (designs, elements)
    const double* most;     // (designs, drives) longest steps
    const double* sizes;    // (designs,)
    const double* signs;    // (designs, dyads); NaN for a design that is not to be moved
    const double* starts;   // (designs, unknowns)
};

// What is written of each design, NaN in rows that were not reached.
struct DesignPoses {
    Complex* places;  // (order + 1, designs, kept, rows)
    Complex* turns;   // (designs, kept, rows)
    double* rates;    // (order, designs, kept, rows)
    std::int64_t* reached;      // (designs,) how many rows
    const std::int64_t* kept;   // the links that are written
    std::int64_t designs, kept_count;
    int order;
};

// Moves the designs from `first` to the one before `last`; false if it was interrupted.
bool move_designs(const Program& program, OwnPlan& plan, const Path& path, const Designs& designs,
                  const DesignPoses& out, std::int64_t first, std::int64_t last, Sweep* sweep, Watch& watch);

}  // namespace gruebler::motion
