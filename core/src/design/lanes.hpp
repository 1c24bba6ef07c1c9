// A crank and RRR dyads at many crank angles at once, for each level of the processor, with the same bits.
#pragma once

#include <cstdint>

#include "base/level.hpp"
#include "motion/complex.hpp"

namespace gruebler::design {

inline namespace GRUEBLER_LEVEL {}

using motion::Complex;

// A plane at each angle: a point w goes to turn w + shift.
struct PlaneRows {
    double *turn_x, *turn_y, *shift_x, *shift_y;
};

struct RrrRows {
    PlaneRows bases[2], links[2];
    double* cosine;
    Complex on_base[2], on_link[2], inner[2];
    double side;
    std::int64_t angles;
};

// The crank turned about `own` of the frame, where its point `far` stays.
using TurnCrank = void(const double* angle, Complex own, Complex far, const PlaneRows& crank, std::int64_t angles);
using PlaceRrr = void(const RrrRows& rows);

struct Lanes {
    TurnCrank* turn_crank;
    PlaceRrr* place_rrr;
};

namespace baseline {
TurnCrank turn_crank;
PlaceRrr place_rrr;
}  // namespace baseline
namespace v3 {
TurnCrank turn_crank;
PlaceRrr place_rrr;
}  // namespace v3
namespace v4 {
TurnCrank turn_crank;
PlaceRrr place_rrr;
}  // namespace v4

}  // namespace gruebler::design
