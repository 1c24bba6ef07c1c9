// Rods between two balls: their spin is idle, and is fixed by a rule, the shortest turn from the reference pose.
//
// With the directions u of the rod in the reference pose and v now, s = u + v, that turn is two half turns, about u and
// then about s. It depends on v alone, not on the way there. Where the rod points back, s is nearly 0, and the way leads by
// a direction across u.
#pragma once

#include "space/frames.hpp"

namespace gruebler::space {

inline constexpr int rod_fields = 3;    // the rod, the links of its first and of its second ball
inline constexpr int rod_vectors = 5;   // the balls on those links, the balls on the rod, a unit vector across it

// The frames of a rod from those of the links of its balls, power series in time: [orders + 1] each.
void place_rod(const double* vectors, const Frame<double>* first, const Frame<double>* second, Frame<double>* rod,
               int orders);

}  // namespace gruebler::space
