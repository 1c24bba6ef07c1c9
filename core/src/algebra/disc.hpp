// Discs in the complex plane that hold all that rounding, and their own radius, leave open.
#pragma once

#include <limits>

#include "algebra/complex.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {

// More than the relative error of any sum, product or quotient of complex doubles, or of three operations with reals.
inline constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();

struct Disc {
    Complex centre;
    double radius = 0;

    Disc() = default;
    explicit Disc(Complex exact) : centre(exact) {}
    Disc(Complex about, double radius) : centre(about), radius(radius) {}

    // The disc about a rounded centre: an error of that rounding, and of the computation of the radius.
    static Disc rounded(Complex centre, double radius) {
        return {centre, radius * (1 + rounding) + rounding * modulus(centre)};
    }
};

inline Disc operator-(const Disc& u) { return {-u.centre, u.radius}; }
inline Disc operator+(const Disc& u, const Disc& v) { return Disc::rounded(u.centre + v.centre, u.radius + v.radius); }
inline Disc operator-(const Disc& u, const Disc& v) { return u + -v; }

inline Disc operator*(const Disc& u, const Disc& v) {
    const double spread = modulus(u.centre) * v.radius + modulus(v.centre) * u.radius + u.radius * v.radius;
    return Disc::rounded(u.centre * v.centre, spread);
}

// With q the quotient of the centres, u/v - q = ((u - u0) - q (v - v0)) / v. A disc about 0 divides nothing.
inline Disc operator/(const Disc& u, const Disc& v) {
    const Complex quotient = u.centre / v.centre;
    const double least = modulus(v.centre) * (1 - rounding) - v.radius;
    if (!(least > 0)) return {quotient, std::numeric_limits<double>::infinity()};
    return Disc::rounded(quotient, (u.radius + modulus(quotient) * (1 + rounding) * v.radius) / least);
}

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
