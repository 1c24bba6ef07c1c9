// The inverses of circle and exponential function: the same bits on every system, as products, sums, quotients and roots are.
#pragma once

#include <cmath>

#include "motion/circle.hpp"

namespace gruebler::motion {
namespace {

// The angle of a direction, above -pi to pi, to three ulps; 0 of no direction.
//
// A polynomial (Abramowitz and Stegun 4.4.49, good to 1.4e-4 of the angle) gives a direction so near that the arc between is its sine
// with one more term.
inline double direction_angle(Complex direction) {
    constexpr double quarter = 1.57079632679489661923, half = 3.14159265358979323846;
    const double wide = std::fabs(direction.x), high = std::fabs(direction.y), most = larger(wide, high);
    if (!(most > 0)) return most;
    const double t = smaller(wide, high) / most, z = t * t;
    double angle = t * ((((0.0208351 * z - 0.085133) * z + 0.180141) * z - 0.3302995) * z + 0.999866);
    if (high > wide) angle = quarter - angle;
    if (direction.x < 0) angle = half - angle;
    if (direction.y < 0) angle = -angle;
    const Complex unit = direction / most;
    const double sine = cross(circle(angle), unit) / std::sqrt(dot(unit, unit));
    return angle + (sine + sine * sine * sine / 6);
}

// The logarithm of a positive number, to two ulps: the series of the inverse hyperbolic tangent behind the power of two.
inline double logarithm(double number) {
    constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
    constexpr double root_half = 0.70710678118654752440;
    int power = 0;
    double part = std::frexp(number, &power);
    if (part < root_half) part *= 2, --power;
    const double s = (part - 1) / (part + 1), z = s * s;  // below 0.03
    double series = 0;
    for (int k = 10; k > 0; --k) series = z * (series + 1.0 / (2 * k + 1));
    return power * ln2_high + (2 * s + (2 * s * series + power * ln2_low));
}

}  // namespace
}  // namespace gruebler::motion
