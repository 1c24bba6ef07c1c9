// Cosine and sine without a branch, so that loops over them vectorise: the same bits on every processor.
#pragma once

#include <math.h>

#include "motion/complex.hpp"

namespace gruebler::motion {
namespace {

inline constexpr double reduced = 1e5;  // radians: up to here three parts of pi / 2 leave an error below an ulp

// To an ulp: quarter turns are taken off in three parts of pi / 2, then the polynomials of fdlibm.
inline Complex circle(double angle) {
    constexpr double quarter_turns = 0.63661977236758134308;  // 2 / pi
    constexpr double part_1 = 1.57079632673412561417e+00;
    constexpr double part_2 = 6.07710050630396597660e-11;
    constexpr double part_3 = 2.02226624879595063154e-21;
    constexpr double shift = 6755399441055744.0;  // adding it and taking it off again rounds to a whole number
    const double n = (angle * quarter_turns + shift) - shift;
    const double r = ((angle - n * part_1) - n * part_2) - n * part_3;
    const double quarter = n - 4 * ((n * 0.25 + shift) - shift);  // -2 to 2
    const double z = r * r;
    double s = 1.58969099521155010221e-10 * z - 2.50507602534068634195e-08;
    s = (s * z + 2.75573137070700676789e-06) * z - 1.98412698298579493134e-04;
    s = (s * z + 8.33333333332248946124e-03) * z - 1.66666666666666324348e-01;
    s = r + r * z * s;
    double c = -1.13596475577881948265e-11 * z + 2.08757232129817482790e-09;
    c = (c * z - 2.75573143513906633035e-07) * z + 2.48015872894767294178e-05;
    c = (c * z - 1.38888888888741095749e-03) * z + 4.16666666666666019037e-02;
    const double half = 0.5 * z, high = 1 - half;
    c = high + (((1 - high) - half) + z * z * c);
    // `&` and `|`: a branch would keep a loop from vectorising.
    const bool half_turn = static_cast<int>(quarter == 2) | static_cast<int>(quarter == -2);
    const bool odd = static_cast<int>(quarter == 1) | static_cast<int>(quarter == -1);
    const double x = odd ? s : c, y = odd ? c : s;
    const bool turn_x = static_cast<int>(quarter == 1) | static_cast<int>(half_turn);
    const bool turn_y = static_cast<int>(quarter == -1) | static_cast<int>(half_turn);
    return {turn_x ? -x : x, turn_y ? -y : y};
}

// Of any angle. Beyond `reduced` whole turns are taken off first, 2 pi in two parts; remainders are exact on every system. (Beyond
// 1e21 neighbouring numbers are many turns apart: then it is some point of the circle, everywhere the same.)
inline Complex unit_vector(double angle) {
    if (fabs(angle) < reduced) return circle(angle);
    constexpr double turn = 6.28318530717958647693, rest_of_turn = 2.44929359829470641435e-16;
    const double rest = remainder(angle, turn);
    return circle(remainder(rest - (angle - rest) / turn * rest_of_turn, turn));
}

}  // namespace
}  // namespace gruebler::motion
