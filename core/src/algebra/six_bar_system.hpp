// The equations of six-bars whose input and output links turn through pairs of angles, in isotropic coordinates.
//
// Two loops share a link that turns by T from the first pair to another one. Each says that a length stays,
//
//     (w + p T)(w* + p*/T) = (w_0 + p)(w_0* + p*),
//
// w a sum of the other vectors, w_0 the same in the first pair. Linear in T and 1/T, they give p w* T + p* w/T + k = 0;
// T and 1/T are the minors of both, and their product is 1. Input and output turn by Q and U; a is the input's arm, f the
// output's, the frame from the input's pivot to the next one is 1:
//
//     Watt II           w = 1 - a Q,  1 - f U        T is the ternary rocker, p and q its arms, f in units of its frame
//     Stephenson III    w = a Q - 1,  a Q - c - f U  T is the coupler, c the pivot of the output
//
// Theory: docs/theory/synthesis-functions.md.
#pragma once

#include "algebra/four_bar.hpp"
#include "algebra/lanes.hpp"
#include "algebra/sharp_complex.hpp"
#include "algebra/tracking.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {

// The other vectors of a loop, in a pair and in the first one, and their conjugates; or derivatives by them.
template <class Number>
struct LoopVectors {
    Number w, wc, first, first_c;
};

template <class Number>
Coefficients<Number> coefficients(const Number& p, const Number& pc, const LoopVectors<Number>& l) {
    return {p * l.wc, pc * l.w, l.w * l.wc - l.first * l.first_c - p * l.first_c - pc * l.first};
}

// What is left of T (1/T) = 1, times the square of the last minor.
template <class Number>
Number of_turn(const Minors<Number>& m) {
    return m.bc * m.ca - m.ab * m.ab;
}

struct SixBarSystem {
    Family family;
    int pairs;  // besides the first

    // Turns of input and output, and of the last equation, which is there if seven pairs leave one unknown free,
    // sum c_k z_k + product p p* = constant, all numbers; then the pivot of the output.
    struct Parameters {
        Lanes input, output, linear;
        Complex constant, product, pivot, pivot_c;

        // complex[4, 8], as pairs of doubles.
        static Parameters read(const double* numbers) {
            const auto number = [numbers](int k) { return Complex{numbers[2 * k], numbers[2 * k + 1]}; };
            Parameters p;
            for (int i = 0; i < lanes; ++i) {
                p.input.set(i, number(i));
                p.output.set(i, number(lanes + i));
                p.linear.set(i, number(2 * lanes + i));
            }
            p.constant = number(3 * lanes);
            p.product = number(3 * lanes + 1);
            p.pivot = number(3 * lanes + 2);
            p.pivot_c = number(3 * lanes + 3);
            return p;
        }
    };

    // A straight way from task to task.
    struct Way {
        Parameters begin, speed;

        static Way between(const Parameters& begin, const Parameters& end) {
            Way way{begin, end};
            way.combine(way.speed, end, begin, -1);
            return way;
        }
        void at(double time, Parameters& p) const { combine(p, begin, speed, time); }

    private:
        static void combine(Parameters& out, const Parameters& first, const Parameters& second, double k) {
            for (int i = 0; i < lanes; ++i) {
                out.input.set(i, first.input.at(i) + k * second.input.at(i));
                out.output.set(i, first.output.at(i) + k * second.output.at(i));
                out.linear.set(i, first.linear.at(i) + k * second.linear.at(i));
            }
            out.constant = first.constant + k * second.constant;
            out.product = first.product + k * second.product;
            out.pivot = first.pivot + k * second.pivot;
            out.pivot_c = first.pivot_c + k * second.pivot_c;
        }
    };

    void evaluate(const Complex* z, const Parameters& p, Matrix& jacobian, Lanes& values) const {
        Lanes none;
        evaluate_with_rates(z, p, {}, jacobian, values, none);
    }

    void evaluate_with_rates(const Complex* z, const Parameters& p, const Parameters& speed, Matrix& jacobian,
                             Lanes& values, Lanes& rates) const {
        constexpr Complex one{1, 0};
        for (Lanes& column : jacobian.column) column.clear();
        values.clear();
        rates.clear();
        const bool watt = family == Family::watt_2;
        for (int j = 0; j < pairs; ++j) {
            const Complex turn = p.input.at(j), out = p.output.at(j), back = one / turn, out_back = one / out;
            LoopVectors<Complex> l, m;
            vectors(z, p, j, l, m);
            const Coefficients<Complex> k = coefficients(z[4], z[5], l), n = coefficients(z[6], z[7], m);
            const Minors<Complex> minor = minors(k, n);
            values.set(j, of_turn(minor));
            const Complex by_bc = minor.ca, by_ca = minor.bc, by_ab = -2.0 * minor.ab;
            const Coefficients<Complex> u{by_ab * n.b - by_ca * n.c, by_bc * n.c - by_ab * n.a,
                                          by_ca * n.a - by_bc * n.b};
            const Coefficients<Complex> v{by_ca * k.c - by_ab * k.b, by_ab * k.a - by_bc * k.c,
                                          by_bc * k.b - by_ca * k.a};
            set(jacobian, j, 4, l.wc * u.a - l.first_c * u.c, l.w * u.b - l.first * u.c);
            set(jacobian, j, 6, m.wc * v.a - m.first_c * v.c, m.w * v.b - m.first * v.c);
            const LoopVectors<Complex> d = by_vectors(z[4], z[5], l, u), e = by_vectors(z[6], z[7], m, v);
            // The crank's arm is in both loops of Stephenson's, with the other sign in Watt's.
            const Complex w = watt ? -d.w : d.w + e.w, wc = watt ? -d.wc : d.wc + e.wc;
            const Complex first = watt ? -d.first : d.first + e.first;
            const Complex first_c = watt ? -d.first_c : d.first_c + e.first_c;
            set(jacobian, j, 0, turn * w + first, back * wc + first_c);
            set(jacobian, j, 2, -(out * e.w) - e.first, -(out_back * e.wc) - e.first_c);
            Complex rate = (z[0] * w - z[1] * wc * back * back) * speed.input.at(j) -
                           (z[2] * e.w - z[3] * e.wc * out_back * out_back) * speed.output.at(j);
            if (!watt) rate = rate - (e.w + e.first) * speed.pivot - (e.wc + e.first_c) * speed.pivot_c;
            rates.set(j, rate);
        }
        if (pairs == unknowns) return;
        for (int i = 0; i < unknowns; ++i) jacobian.column[i].set(pairs, p.linear.at(i));
        set(jacobian, pairs, 4, p.linear.at(4) + p.product * z[5], p.linear.at(5) + p.product * z[4]);
        values.set(pairs, of_last(z, p));
        rates.set(pairs, of_last(z, speed));
    }

    void evaluate_sharply(const Complex* z, const Parameters& p, Lanes& out) const {
        SharpComplex sharp[unknowns];
        for (int i = 0; i < unknowns; ++i) sharp[i] = SharpComplex(z[i]);
        for (int j = 0; j < pairs; ++j) {
            LoopVectors<SharpComplex> l, m;
            vectors(sharp, p, j, l, m);
            const Coefficients<SharpComplex> k = coefficients(sharp[4], sharp[5], l);
            out.set(j, of_turn(minors(k, coefficients(sharp[6], sharp[7], m))).rounded());
        }
        if (pairs < unknowns) out.set(pairs, of_last(sharp, p).rounded());
    }

private:
    static void set(Matrix& jacobian, int row, int column, Complex by, Complex by_conjugate) {
        jacobian.column[column].set(row, by);
        jacobian.column[column + 1].set(row, by_conjugate);
    }

    static LoopVectors<Complex> by_vectors(Complex p, Complex pc, const LoopVectors<Complex>& l,
                                           const Coefficients<Complex>& by) {
        return {pc * by.b + l.wc * by.c, p * by.a + l.w * by.c, -((l.first_c + pc) * by.c), -((l.first + p) * by.c)};
    }

    template <class Number>
    Number of_last(const Number* z, const Parameters& p) const {
        Number value = Number(p.product) * z[4] * z[5] - Number(p.constant);
        for (int i = 0; i < unknowns; ++i) value = value + Number(p.linear.at(i)) * z[i];
        return value;
    }

    template <class Number>
    void vectors(const Number* z, const Parameters& p, int j, LoopVectors<Number>& l, LoopVectors<Number>& m) const {
        const Number one(Complex{1, 0}), turn(p.input.at(j)), out(p.output.at(j));
        const Number in = z[0] * turn, in_c = z[1] / turn, arm = z[2] * out, arm_c = z[3] / out;
        if (family == Family::watt_2) {
            l = {one - in, one - in_c, one - z[0], one - z[1]};
            m = {one - arm, one - arm_c, one - z[2], one - z[3]};
            return;
        }
        const Number c(p.pivot), cc(p.pivot_c);
        l = {in - one, in_c - one, z[0] - one, z[1] - one};
        m = {in - c - arm, in_c - cc - arm_c, z[0] - c - z[2], z[1] - cc - z[3]};
    }
};

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
