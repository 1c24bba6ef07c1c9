// The equations of Watt I six-bars that carry a body through positions, in isotropic coordinates.
//
// The frame has the pivots A and B. A crank A-C, the coupler C-D-H and the ternary rocker B-D-F are a four-bar; the body
// has its pins at H and, by a link, at F. From the first position to another one the body turns by T and is displaced by
// P, the rocker turns by U. With the pins of the first position, d = D - B, f = F - B, and c = (C - D) / (H - D), three
// lengths stay, those of D H, F G and A C: each is that of w + p U,
//
//     w = P + T H - B,   p = -d        w = P + T G - B,   p = -f        w = B - A + c (P + T H - B),   p = (1 - c) d,
//
// linear in U and 1/U, so that two equations a position are left without them: 1/U is that of U, and the determinant is
// zero. Of c, d, f, G, H, B - A, B the last ones are given if there are fewer positions than eight.
// Theory: docs/theory/synthesis-positions.md.
#pragma once

#include "algebra/six_bar_system.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {

// The rows of a task: T; P and its conjugate; the values of the unknowns that no equation is left for, at their places.
// Of ten unknowns B - A and B are given, at the places 0 to 3. The conjugate of the last displacement is less by c times
// a number at place 9 of the first row: other planes that cut the curve of all six-bars through the other numbers.
template <int own_unknowns>
struct GuidanceSystem {
    static constexpr int unknowns = own_unknowns, tilt = 9;
    static constexpr bool pivots_given = unknowns == 10;
    static_assert(pivots_given || unknowns == 14);
    using Lanes = LanesOf<unknowns>;
    using Matrix = MatrixOf<unknowns>;
    using Task = TaskOf<unknowns>;

    int positions;  // besides the first

    void evaluate(const Complex* z, const Task& p, Matrix& jacobian, Lanes& values) const {
        Lanes none;
        evaluate_with_rates(z, p, {}, jacobian, values, none);
    }

    void evaluate_with_rates(const Complex* z, const Task& p, const Task& speed, Matrix& jacobian, Lanes& values,
                             Lanes& rates) const {
        for (Lanes& column : jacobian.column) column.clear();
        values.clear();
        rates.clear();
        const Pins<Complex> pins = pins_of<Complex>(z, p);
        for (int j = 0; j < positions; ++j) {
            const Position<Complex> at = position_of(pins, p, j), rate = rate_of(pins, p, speed, j);
            const Lengths<Complex> l = lengths_of(pins, at);
            const Coefficients<Complex> k = l.coefficients(0), m = l.coefficients(1), n = l.coefficients(2);
            const Minors<Complex> minor = minors(k, m), by_k = minors(m, n), by_m = minors(n, k);
            values.set(2 * j, of_turn(minor));
            values.set(2 * j + 1, determinant(n, minor));
            const Coefficients<Complex> by_turn[] = {by_first_of_turn(minor, m), by_second_of_turn(minor, k), {}};
            const Coefficients<Complex> by_determinant[] = {
                {by_k.bc, by_k.ca, by_k.ab}, {by_m.bc, by_m.ca, by_m.ab}, {minor.bc, minor.ca, minor.ab}};
            const auto write = [&](int row, const Coefficients<Complex>(&weight)[3]) {
                const Slopes slopes = slopes_of(pins, at, l, weight);
                for (int c = 0; c < unknowns; ++c) jacobian.column[c].set(row, slopes.by[c]);
                if (j == positions - 1)
                    jacobian.column[0].set(row, slopes.by[0] - p.row[0].at(tilt) * slopes.shift_c);
                Complex sum = slopes.turn * rate.turn + slopes.back * rate.back + slopes.shift * rate.shift +
                              slopes.shift_c * rate.shift_c;
                if constexpr (pivots_given)
                    sum = sum + slopes.by[10] * speed.row[3].at(0) + slopes.by[11] * speed.row[3].at(1) +
                          slopes.by[12] * speed.row[3].at(2) + slopes.by[13] * speed.row[3].at(3);
                rates.set(row, sum);
            };
            write(2 * j, by_turn);
            write(2 * j + 1, by_determinant);
        }
        for (int r = 2 * positions; r < unknowns; ++r) {
            jacobian.column[r].set(r, {1, 0});
            values.set(r, z[r] - p.row[3].at(r));
            rates.set(r, -speed.row[3].at(r));
        }
    }

    void evaluate_sharply(const Complex* z, const Task& p, Lanes& out) const {
        const Pins<SharpComplex> pins = pins_of<SharpComplex>(z, p);
        for (int j = 0; j < positions; ++j) {
            const Lengths<SharpComplex> l = lengths_of(pins, position_of(pins, p, j));
            const Minors<SharpComplex> minor = minors(l.coefficients(0), l.coefficients(1));
            out.set(2 * j, of_turn(minor).rounded());
            out.set(2 * j + 1, determinant(l.coefficients(2), minor).rounded());
        }
        for (int r = 2 * positions; r < unknowns; ++r) out.set(r, z[r] - p.row[3].at(r));
    }

private:
    // Each with its conjugate; e leads from A to B.
    template <class Number>
    struct Pins {
        Number c, cc, d, dc, f, fc, g, gc, h, hc, e, ec, b, bc;
    };
    template <class Number>
    struct Position {
        Number turn, back, shift, shift_c;
    };
    template <class Number>
    struct Lengths {
        LoopVectors<Number> w[3];
        Number p[3], pc[3];
        Coefficients<Number> coefficients(int i) const { return algebra::coefficients(p[i], pc[i], w[i]); }
    };
    struct Slopes {
        Complex by[14], turn, back, shift, shift_c;
    };

    template <class Number>
    static Pins<Number> pins_of(const Complex* z, const Task& p) {
        Complex all[14];
        for (int i = 0; i < unknowns; ++i) all[i] = z[i];
        if constexpr (pivots_given)
            for (int i = 0; i < 4; ++i) all[10 + i] = p.row[3].at(i);
        const auto at = [&all](int i) { return Number(all[i]); };
        return {at(0), at(1), at(2), at(3),  at(4),  at(5),  at(6),
                at(7), at(8), at(9), at(10), at(11), at(12), at(13)};
    }

    template <class Number>
    Position<Number> position_of(const Pins<Number>& z, const Task& p, int j) const {
        const Number turn(p.row[0].at(j)), shift(p.row[1].at(j)), shift_c(p.row[2].at(j));
        const Number back = Number(Complex{1, 0}) / turn;
        return {turn, back, shift, j < positions - 1 ? shift_c : shift_c - Number(p.row[0].at(tilt)) * z.c};
    }

    Position<Complex> rate_of(const Pins<Complex>& z, const Task& p, const Task& speed, int j) const {
        const Complex turn = p.row[0].at(j), rate = speed.row[0].at(j), shift_c = speed.row[2].at(j);
        return {rate, -rate / (turn * turn), speed.row[1].at(j),
                j < positions - 1 ? shift_c : shift_c - speed.row[0].at(tilt) * z.c};
    }

    template <class Number>
    static Lengths<Number> lengths_of(const Pins<Number>& z, const Position<Number>& at) {
        const Number one(Complex{1, 0});
        const LoopVectors<Number> h{at.shift + at.turn * z.h - z.b, at.shift_c + at.back * z.hc - z.bc, z.h - z.b,
                                    z.hc - z.bc};
        return {{h,
                 {at.shift + at.turn * z.g - z.b, at.shift_c + at.back * z.gc - z.bc, z.g - z.b, z.gc - z.bc},
                 {z.e + z.c * h.w, z.ec + z.cc * h.wc, z.e + z.c * h.first, z.ec + z.cc * h.first_c}},
                {-z.d, -z.f, (one - z.c) * z.d},
                {-z.dc, -z.fc, (one - z.cc) * z.dc}};
    }

    template <class Number>
    static Number determinant(const Coefficients<Number>& k, const Minors<Number>& m) {
        return k.a * m.bc + k.b * m.ca + k.c * m.ab;
    }

    // What changes with coefficients of these weights.
    static Slopes slopes_of(const Pins<Complex>& z, const Position<Complex>& at, const Lengths<Complex>& l,
                            const Coefficients<Complex> (&weight)[3]) {
        // No loop over the three: of one GCC makes fused products, with other bits.
        const auto of = [&](int i) { return by_vectors(l.p[i], l.pc[i], l.w[i], weight[i]); };
        const auto arm = [&](int i) { return by_arm(l.w[i], weight[i]); };
        const auto arm_c = [&](int i) { return by_conjugate_arm(l.w[i], weight[i]); };
        const LoopVectors<Complex> own = of(0), g = of(1), e = of(2);
        const LoopVectors<Complex> h{own.w + z.c * e.w, own.wc + z.cc * e.wc, own.first + z.c * e.first,
                                     own.first_c + z.cc * e.first_c};
        const Complex one{1, 0};
        return {{l.w[0].w * e.w + l.w[0].first * e.first - z.d * arm(2),
                 l.w[0].wc * e.wc + l.w[0].first_c * e.first_c - z.dc * arm_c(2),
                 (one - z.c) * arm(2) - arm(0), (one - z.cc) * arm_c(2) - arm_c(0), -arm(1), -arm_c(1),
                 at.turn * g.w + g.first, at.back * g.wc + g.first_c, at.turn * h.w + h.first,
                 at.back * h.wc + h.first_c, e.w + e.first, e.wc + e.first_c, -(h.w + h.first + g.w + g.first),
                 -(h.wc + h.first_c + g.wc + g.first_c)},
                z.h * h.w + z.g * g.w,
                z.hc * h.wc + z.gc * g.wc,
                h.w + g.w,
                h.wc + g.wc};
    }
};

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
