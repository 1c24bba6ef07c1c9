// Complex numbers written out, so that every compiler gives the same bits; the library's own look for infinities.
#pragma once

#include <cmath>

#include "base/level.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {

struct Complex {
    double re = 0, im = 0;
};

GRUEBLER_INLINE Complex operator+(Complex u, Complex v) { return {u.re + v.re, u.im + v.im}; }
GRUEBLER_INLINE Complex operator-(Complex u, Complex v) { return {u.re - v.re, u.im - v.im}; }
GRUEBLER_INLINE Complex operator-(Complex u) { return {-u.re, -u.im}; }
GRUEBLER_INLINE Complex operator*(Complex u, Complex v) {
    return {u.re * v.re - u.im * v.im, u.re * v.im + u.im * v.re};
}
GRUEBLER_INLINE Complex operator*(double k, Complex u) { return {k * u.re, k * u.im}; }

// After Smith: no square overflows.
GRUEBLER_INLINE Complex operator/(Complex u, Complex v) {
    if (std::fabs(v.re) >= std::fabs(v.im)) {
        const double ratio = v.im / v.re, whole = v.re + v.im * ratio;
        return {(u.re + u.im * ratio) / whole, (u.im - u.re * ratio) / whole};
    }
    const double ratio = v.re / v.im, whole = v.re * ratio + v.im;
    return {(u.re * ratio + u.im) / whole, (u.im * ratio - u.re) / whole};
}

GRUEBLER_INLINE double modulus(Complex u) { return std::sqrt(u.re * u.re + u.im * u.im); }

// Within a factor of the square root of 2 of the modulus.
GRUEBLER_INLINE double size(Complex u) { return std::fabs(u.re) + std::fabs(u.im); }

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
