// Complex numbers of twice the digits: 32 of them.
//
// A real number is the sum of two doubles, the second what rounding left of the first. Source: T. J. Dekker, A
// floating-point technique for extending the available precision, Numer. Math. 18 (1971) 224-242.
#pragma once

#include "algebra/complex.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {

struct SharpReal {
    double high = 0, low = 0;
};

GRUEBLER_INLINE SharpReal operator-(SharpReal a) { return {-a.high, -a.low}; }

GRUEBLER_INLINE SharpReal operator+(SharpReal a, SharpReal b) {
    const double sum = a.high + b.high, part = sum - a.high;
    const double rest = ((a.high - (sum - part)) + (b.high - part)) + (a.low + b.low);
    const double high = sum + rest;
    return {high, rest - (high - sum)};
}

// The upper and the lower half of the digits of a double.
GRUEBLER_INLINE SharpReal halves(double a) {
    constexpr double shift = 134217729;  // 2^27 + 1
    const double shifted = shift * a, high = shifted - (shifted - a);
    return {high, a - high};
}

GRUEBLER_INLINE SharpReal operator*(SharpReal a, SharpReal b) {
    const double product = a.high * b.high;
    const SharpReal u = halves(a.high), v = halves(b.high);
    double rest = ((u.high * v.high - product) + u.high * v.low + u.low * v.high) + u.low * v.low;
    rest += a.high * b.low + a.low * b.high;
    const double high = product + rest;
    return {high, rest - (high - product)};
}

struct SharpComplex {
    SharpReal re, im;

    SharpComplex() = default;
    SharpComplex(SharpReal real, SharpReal imaginary) : re(real), im(imaginary) {}
    explicit SharpComplex(Complex u) : re{u.re, 0}, im{u.im, 0} {}
    Complex rounded() const { return {re.high, im.high}; }
};

GRUEBLER_INLINE SharpComplex operator+(const SharpComplex& u, const SharpComplex& v) {
    return {u.re + v.re, u.im + v.im};
}
GRUEBLER_INLINE SharpComplex operator-(const SharpComplex& u, const SharpComplex& v) {
    return {u.re + -v.re, u.im + -v.im};
}
GRUEBLER_INLINE SharpComplex operator-(const SharpComplex& u) { return {-u.re, -u.im}; }
GRUEBLER_INLINE SharpComplex operator*(const SharpComplex& u, const SharpComplex& v) {
    return {u.re * v.re + -(u.im * v.im), u.re * v.im + u.im * v.re};
}

// A quotient in double precision, and what its rounding left.
GRUEBLER_INLINE SharpComplex operator/(const SharpComplex& u, const SharpComplex& v) {
    const SharpComplex near(u.rounded() / v.rounded());
    const SharpComplex rest = u - near * v;
    return near + SharpComplex(rest.rounded() / v.rounded());
}

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
