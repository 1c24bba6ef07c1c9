// The equations of four-bars through positions and points, in isotropic coordinates.
//
// A four-bar is two dyads. A dyad has its moving pivot x in the first position and its fixed pivot a; the coupler point
// of the first position is the origin. Conjugates (x*, a*) are unknowns of their own. The body is displaced by t, with
// the conjugate s, and turned by 1 + g; that turn's conjugate is 1 + h. That the length of the dyad stays is
//
//     A g + B h + C = 0,   A = x (a* - s),   B = x* (a - t),   C = t (a* - x*) + s (a - x) - t s.
//
// Of a position t, s, g are given and h = -g/(1 + g): one equation for each dyad. Of a point g and h are eliminated
// from both equations and g + h + g h = 0. Theory: docs/theory/synthesis-points.md. The same source is evaluated with
// complex numbers, with twice the digits, and with discs.
#pragma once

#include "base/level.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {

inline constexpr int unknowns = 8;  // x, x*, y, y* (moving pivots), a, a*, b, b* (fixed pivots)

template <class Number>
struct Dyad {
    Number x, xc, a, ac;  // moving pivot, fixed pivot, and their conjugates
};

// A value for each number of a dyad: derivatives.
template <class Number>
using ByDyad = Dyad<Number>;

// The coefficients of the equation of one dyad.
template <class Number>
struct Coefficients {
    Number a, b, c;
};

template <class Number>
GRUEBLER_INLINE Coefficients<Number> coefficients(const Dyad<Number>& d, const Number& t, const Number& s) {
    return {d.x * (d.ac - s), d.xc * (d.a - t), t * (d.ac - d.xc) + s * (d.a - d.x) - t * s};
}

// How coefficients with these weights change with the dyad, and with t and s.
template <class Number>
GRUEBLER_INLINE ByDyad<Number> by_dyad(const Dyad<Number>& d, const Number& t, const Number& s,
                                       const Coefficients<Number>& weight) {
    return {weight.a * (d.ac - s) - weight.c * s, weight.b * (d.a - t) - weight.c * t,
            weight.b * d.xc + weight.c * s, weight.a * d.x + weight.c * t};
}

template <class Number>
GRUEBLER_INLINE Number by_t(const Dyad<Number>& d, const Number& s, const Coefficients<Number>& weight) {
    return weight.c * (d.ac - d.xc - s) - weight.b * d.xc;
}

template <class Number>
GRUEBLER_INLINE Number by_s(const Dyad<Number>& d, const Number& t, const Coefficients<Number>& weight) {
    return weight.c * (d.a - d.x - t) - weight.a * d.x;
}

// What is left of the equation of a dyad in a position.
template <class Number>
GRUEBLER_INLINE Number of_position(const Coefficients<Number>& k, const Number& g, const Number& h) {
    return k.a * g + k.b * h + k.c;
}

// The minors of the equations of both dyads: g : h : 1 = bc : ca : ab.
template <class Number>
struct Minors {
    Number bc, ca, ab;
};

template <class Number>
GRUEBLER_INLINE Minors<Number> minors(const Coefficients<Number>& k, const Coefficients<Number>& l) {
    return {k.b * l.c - l.b * k.c, k.c * l.a - l.c * k.a, k.a * l.b - l.a * k.b};
}

// What is left of g + h + g h = 0, times the square of the last minor.
template <class Number>
GRUEBLER_INLINE Number of_point(const Minors<Number>& m) {
    return (m.bc + m.ca) * m.ab + m.bc * m.ca;
}

// How that changes with the coefficients of the first dyad, of which the minors are determinants, and of the second.
template <class Number>
GRUEBLER_INLINE Coefficients<Number> by_first(const Minors<Number>& m, const Coefficients<Number>& l) {
    const Number by_bc = m.ab + m.ca, by_ca = m.ab + m.bc, by_ab = m.bc + m.ca;
    return {by_ab * l.b - by_ca * l.c, by_bc * l.c - by_ab * l.a, by_ca * l.a - by_bc * l.b};
}

template <class Number>
GRUEBLER_INLINE Coefficients<Number> by_second(const Minors<Number>& m, const Coefficients<Number>& k) {
    const Number by_bc = m.ab + m.ca, by_ca = m.ab + m.bc, by_ab = m.bc + m.ca;
    return {by_ca * k.c - by_ab * k.b, by_ab * k.a - by_bc * k.c, by_bc * k.b - by_ca * k.a};
}

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
