// Compiled once for each level of the processor. Of the standard library only what leaves no shared function behind.
#include "design/lanes.hpp"

#include <math.h>

#include "motion/circle.hpp"

// As in motion/sweep.cpp, of which the modules of the page are made: the lanes of a loop are independent of one another.
#if defined(__clang__)
#define EACH_LANE _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define EACH_LANE _Pragma("GCC ivdep")
#else
#define EACH_LANE __pragma(loop(ivdep))
#endif

namespace gruebler::design::inline GRUEBLER_LEVEL {

using namespace motion;

void turn_crank(const double* angle, Complex own, Complex far, const PlaneRows& crank, std::int64_t angles) {
    double *turn_x = crank.turn_x, *turn_y = crank.turn_y, *shift_x = crank.shift_x, *shift_y = crank.shift_y;
    bool near = true;
    for (std::int64_t i = 0; i < angles; ++i) near &= fabs(angle[i]) < reduced;
    if (near) {
        EACH_LANE
        for (std::int64_t i = 0; i < angles; ++i) {
            const Complex turn = circle(angle[i]), shift = own - turn * far;
            turn_x[i] = turn.x, turn_y[i] = turn.y;
            shift_x[i] = shift.x, shift_y[i] = shift.y;
        }
        return;
    }
    for (std::int64_t i = 0; i < angles; ++i) {
        const Complex turn = unit_vector(angle[i]), shift = own - turn * far;
        turn_x[i] = turn.x, turn_y[i] = turn.y;
        shift_x[i] = shift.x, shift_y[i] = shift.y;
    }
}

void place_rrr(const RrrRows& rows) {
    const PlaneRows &a = rows.bases[0], &b = rows.bases[1], &c = rows.links[0], &d = rows.links[1];
    const double *a_turn_x = a.turn_x, *a_turn_y = a.turn_y, *a_shift_x = a.shift_x, *a_shift_y = a.shift_y;
    const double *b_turn_x = b.turn_x, *b_turn_y = b.turn_y, *b_shift_x = b.shift_x, *b_shift_y = b.shift_y;
    double *c_turn_x = c.turn_x, *c_turn_y = c.turn_y, *c_shift_x = c.shift_x, *c_shift_y = c.shift_y;
    double *d_turn_x = d.turn_x, *d_turn_y = d.turn_y, *d_shift_x = d.shift_x, *d_shift_y = d.shift_y;
    double* cosine = rows.cosine;
    const Complex on_a = rows.on_base[0], on_b = rows.on_base[1], on_c = rows.on_link[0], on_d = rows.on_link[1];
    const Complex first = rows.inner[0] - on_c, second = rows.inner[1] - on_d;
    const double r = dot(first, first), s = dot(second, second), product = 2 * sqrt(r * s), side = rows.side;
    const Complex by_first = inverse(first, r), by_second = inverse(second, s);
    const std::int64_t angles = rows.angles;
    EACH_LANE
    for (std::int64_t i = 0; i < angles; ++i) {
        const Complex end = Complex{a_turn_x[i], a_turn_y[i]} * on_a + Complex{a_shift_x[i], a_shift_y[i]};
        const Complex other = Complex{b_turn_x[i], b_turn_y[i]} * on_b + Complex{b_shift_x[i], b_shift_y[i]};
        const Complex gap = other - end;
        const double square = dot(gap, gap), distance = sqrt(square);
        const double along = (r - s + square) / (2 * distance);
        const double across = side * sqrt(r - along * along);
        const Complex arm = (1 / distance) * (gap * Complex{along, across});
        const Complex own = arm * by_first, far = (arm - gap) * by_second;
        const Complex own_shift = end - own * on_c, far_shift = other - far * on_d;
        c_turn_x[i] = own.x, c_turn_y[i] = own.y, c_shift_x[i] = own_shift.x, c_shift_y[i] = own_shift.y;
        d_turn_x[i] = far.x, d_turn_y[i] = far.y, d_shift_x[i] = far_shift.x, d_shift_y[i] = far_shift.y;
        cosine[i] = (r + s - square) / product;
    }
}

}  // namespace gruebler::design::inline GRUEBLER_LEVEL
