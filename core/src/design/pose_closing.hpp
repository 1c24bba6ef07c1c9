// Poses of one linkage of turning and sliding joints at any of its dimensions: closed, moved, and how they change with these.
//
// Unknowns are x, y, angle of each moving body; dimensions are x, y of each joint on each of its bodies, of a slide its angle
// besides. Theory: docs/theory/synthesis-any.md.
#pragma once

#include <cstdint>
#include <string>

#include "base/watch.hpp"

namespace gruebler::design {

// Two equations each: of a turning joint that both points meet; of a sliding one that the second point lies on the line of the
// first body, and that both lines point the same way, but for their sense.
struct ClosedJoint {
    std::int64_t bodies[2];  // the frame comes after all moving bodies
    std::int64_t at[2];      // the dimensions that are x of the joint on each of them
    std::int64_t slides;     // 0 or 1
};

struct Closing {
    const ClosedJoint* joints;
    std::int64_t joint_count, body_count, size_count, pose_count;
    const double* q;  // [poses, unknowns]
    const double* p;  // [dimensions]
    double size;      // at this distance from its body's origin a point moves as far as the body turns

    std::int64_t unknowns() const { return 3 * body_count; }
    std::int64_t equations() const { return 2 * joint_count; }
    std::int64_t freedoms() const { return unknowns() > equations() ? unknowns() - equations() : 1; }
};

// A message for what is no linkage, else empty: bodies or dimensions that are none, more equations than unknowns.
std::string fault(const Closing& closing);

// The nearest closed poses by Newton's method with least steps: [poses, unknowns], and whether each was reached, to 1e-12 of the
// size. Cost: for a six-bar 4 us for each pose and step.
bool close_poses(const Closing& closing, std::int64_t steps, double* q, std::uint8_t* reached, Watch& watch);

// How the conditions change with the poses and with the dimensions: [poses, equations, unknowns] and [poses, equations,
// dimensions].
bool pose_slopes(const Closing& closing, double* by_pose, double* by_sizes, Watch& watch);

// How poses move while no dimension changes: [poses, unknowns, freedoms], of length 1 with weights.
bool move_poses(const Closing& closing, double* motion, Watch& watch);

// How quantities of the poses change with the dimensions while the poses do not move along their freedoms: [poses, quantities,
// dimensions] of [poses, quantities, unknowns].
bool pose_gradients(const Closing& closing, std::int64_t quantities, const double* by_pose, double* gradients, Watch& watch);

}  // namespace gruebler::design
