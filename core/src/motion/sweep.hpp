// Many rows of a motion at once: what drives and dyads place.
//
// A sweep does for a block of rows what a walk does for one, operation by operation, in loops without branches. It makes no
// decisions: it tells how many of its rows may be trusted, by the same checks as the walk, and the walk goes on from there.
// docs/theory/kinematics.md has the equations.
#pragma once

#include <cstdint>

#include "base/level.hpp"
#include "motion/plan.hpp"
#include "motion/poses.hpp"

namespace gruebler::motion {

inline constexpr int lanes = 128;      // rows that are placed at once; 64 and 256 are as quick
inline constexpr int swept_rows = 8;   // for fewer rows a sweep does not pay
inline constexpr int most_swept = 62;  // links, as bits of a word

// One link in a block of rows.
struct alignas(64) BodyRows {
    double turn_x[lanes], turn_y[lanes];
    double x[most_orders + 1][lanes], y[most_orders + 1][lanes];
    double rate[most_orders][lanes];
};

// The links that a sweep places, as bits; 0 if it cannot. It can if there are only turning drives between placed links, and
// dyads of two links: RRR, RPR, RRP on the frame.
std::uint64_t swept_links(const Plan& plan);

// Links that nothing places rest at the origin.
void rest(int links, BodyRows* bodies);

// Places everything at up to `lanes` rows from `row` on; returns the first row that is not to be trusted.
//
// The rows before are known, links that are not in `placed` rest; `bodies` (links,) is room to work in. Rows from the returned
// one on are not written, but for their roots, which mean nothing.
using Sweep = std::int64_t(const Plan& plan, const Path& path, const double* signs, std::int64_t row,
                           std::uint64_t placed, const Poses& poses, BodyRows* bodies);

namespace baseline {
Sweep sweep;
}
namespace v3 {
Sweep sweep;
}
namespace v4 {
Sweep sweep;
}

}  // namespace gruebler::motion
