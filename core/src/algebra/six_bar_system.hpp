// The equations of six-bars whose input and output links turn through pairs of angles, in isotropic coordinates.
//
// Two loops share a link that turns by T from the first pair to another one. Each says that a length stays,
//
//     (w + p T)(w* + p*/T) = (w_0 + p)(w_0* + p*),
//
// w a sum of the other vectors, w_0 the same in the first pair. Linear in T and 1/T, they give p w* T + p* w/T + k = 0;
// T and 1/T are the minors of both, and their product is 1. Input and output turn by Q and U:
//
//     Watt II           w = 1 - a Q,        1 - f U         T is the ternary rocker, p and q its arms, f in units of its frame
//     Stephenson II     w = a Q - 1 - f U,  b Q - 1 - f U   T is the ternary link that floats, p and q its arms
//     Stephenson III    w = a Q - 1,        a Q - c - f U   T is the coupler, p and q its arms, c the pivot of the output
//
// Of Stephenson's ten numbers are unknown, or eight if k is given and q = k p. Theory: docs/theory/synthesis-functions.md.
#pragma once

#include "algebra/four_bar.hpp"
#include "algebra/sharp_complex.hpp"
#include "algebra/task.hpp"
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

// How that changes with the coefficients of the first loop, of which the minors are determinants, and of the second.
inline Coefficients<Complex> by_first_of_turn(const Minors<Complex>& m, const Coefficients<Complex>& n) {
    const Complex by_bc = m.ca, by_ca = m.bc, by_ab = -2.0 * m.ab;
    return {by_ab * n.b - by_ca * n.c, by_bc * n.c - by_ab * n.a, by_ca * n.a - by_bc * n.b};
}

inline Coefficients<Complex> by_second_of_turn(const Minors<Complex>& m, const Coefficients<Complex>& k) {
    const Complex by_bc = m.ca, by_ca = m.bc, by_ab = -2.0 * m.ab;
    return {by_ca * k.c - by_ab * k.b, by_ab * k.a - by_bc * k.c, by_bc * k.b - by_ca * k.a};
}

// How coefficients with these weights change with the vectors of a loop, with its arm and its conjugate.
inline LoopVectors<Complex> by_vectors(Complex p, Complex pc, const LoopVectors<Complex>& l,
                                       const Coefficients<Complex>& by) {
    return {pc * by.b + l.wc * by.c, p * by.a + l.w * by.c, -((l.first_c + pc) * by.c), -((l.first + p) * by.c)};
}

inline Complex by_arm(const LoopVectors<Complex>& l, const Coefficients<Complex>& by) {
    return l.wc * by.a - l.first_c * by.c;
}

inline Complex by_conjugate_arm(const LoopVectors<Complex>& l, const Coefficients<Complex>& by) {
    return l.w * by.b - l.first * by.c;
}

enum class With : int { nothing, input, output };  // what a vector turns with

// The vectors of both loops: a constant, and with their signs the first unknowns. The others are the arms.
struct Loops {
    int vectors;  // unknown ones
    With with[3];
    int sign[2][3];
    int constant[2];
};

inline constexpr Loops watt_2{2, {With::input, With::output}, {{-1, 0}, {0, -1}}, {1, 1}};
inline constexpr Loops stephenson_2{3, {With::input, With::input, With::output}, {{1, 0, -1}, {0, 1, -1}}, {-1, -1}};
inline constexpr Loops stephenson_3{3, {With::input, With::output, With::nothing}, {{1, 0, 0}, {1, -1, -1}}, {-1, 0}};

// The rows of a task: turns of input and output; of the last equation, which is there if seven pairs leave one unknown
// free, sum c_k z_k + product p p* = constant, the c_k; then constant, product, k and k*. Where the pairs leave nothing
// free, the last turn of the output is less by the first unknown times the first number of the third row: other planes
// that cut the curve of all six-bars through the other pairs.
template <const Loops& loops, int own_unknowns = 8>
struct SixBarSystem {
    static constexpr int unknowns = own_unknowns, arm = 2 * loops.vectors;  // the unknown of the first loop's arm
    static constexpr bool other_arm = arm + 4 == unknowns;  // the second loop's arm is unknown, too, or k p
    using Lanes = LanesOf<unknowns>;
    using Matrix = MatrixOf<unknowns>;
    using Task = TaskOf<unknowns>;

    int pairs;  // besides the first

    void evaluate(const Complex* z, const Task& p, Matrix& jacobian, Lanes& values) const {
        Lanes none;
        evaluate_with_rates(z, p, {}, jacobian, values, none);
    }

    void evaluate_with_rates(const Complex* z, const Task& p, const Task& speed, Matrix& jacobian, Lanes& values,
                             Lanes& rates) const {
        for (Lanes& column : jacobian.column) column.clear();
        values.clear();
        rates.clear();
        const Arms<Complex> arms = arms_of(z, p);
        for (int j = 0; j < pairs; ++j) {
            const Turns<Complex> turns = turns_of(z, p, j);
            const LoopVectors<Complex> l = vectors<0>(z, turns), m = vectors<1>(z, turns);
            const Coefficients<Complex> k = coefficients(arms.p, arms.pc, l), n = coefficients(arms.q, arms.qc, m);
            const Minors<Complex> minor = minors(k, n);
            values.set(j, of_turn(minor));
            const Coefficients<Complex> u = by_first_of_turn(minor, n), v = by_second_of_turn(minor, k);
            const LoopVectors<Complex> by[2] = {by_vectors(arms.p, arms.pc, l, u), by_vectors(arms.q, arms.qc, m, v)};
            const Complex by_p = by_arm(l, u), by_pc = by_conjugate_arm(l, u);
            const Complex by_q = by_arm(m, v), by_qc = by_conjugate_arm(m, v);
            const Complex speeds[2] = {speed.row[0].at(j), tilted(j) ? tilted_turn(z, speed, j) : speed.row[1].at(j)};
            Complex rate{0, 0}, by_output{0, 0};
            if constexpr (other_arm) {
                set(jacobian, j, arm, by_p, by_pc);
                set(jacobian, j, arm + 2, by_q, by_qc);
            } else {
                set(jacobian, j, arm, by_p + arms.k * by_q, by_pc + arms.kc * by_qc);
                rate = by_q * z[arm] * speed.row[3].at(2) + by_qc * z[arm + 1] * speed.row[3].at(3);
            }
            for (int i = 0; i < loops.vectors; ++i) {
                LoopVectors<Complex> sum{{0, 0}, {0, 0}, {0, 0}, {0, 0}};
                for (int loop = 0; loop < 2; ++loop) {
                    if (loops.sign[loop][i] == 0) continue;
                    const double sign = loops.sign[loop][i];
                    sum = {sum.w + sign * by[loop].w, sum.wc + sign * by[loop].wc, sum.first + sign * by[loop].first,
                           sum.first_c + sign * by[loop].first_c};
                }
                if (loops.with[i] == With::nothing) {
                    set(jacobian, j, 2 * i, sum.w + sum.first, sum.wc + sum.first_c);
                    continue;
                }
                const int row = loops.with[i] == With::input ? 0 : 1;
                const Complex turn = turns.turn[row], back = turns.back[row];
                set(jacobian, j, 2 * i, turn * sum.w + sum.first, back * sum.wc + sum.first_c);
                const Complex by_turn = z[2 * i] * sum.w - z[2 * i + 1] * sum.wc * back * back;
                rate = rate + by_turn * speeds[row];
                if (row == 1) by_output = by_output + by_turn;
            }
            if (tilted(j)) jacobian.column[0].set(j, jacobian.column[0].at(j) - p.row[2].at(0) * by_output);
            rates.set(j, rate);
        }
        if (pairs == unknowns) return;
        const Complex product = p.row[3].at(1);
        for (int i = 0; i < unknowns; ++i) jacobian.column[i].set(pairs, p.row[2].at(i));
        set(jacobian, pairs, arm, p.row[2].at(arm) + product * z[arm + 1], p.row[2].at(arm + 1) + product * z[arm]);
        values.set(pairs, of_last(z, p));
        rates.set(pairs, of_last(z, speed));
    }

    void evaluate_sharply(const Complex* z, const Task& p, Lanes& out) const {
        SharpComplex sharp[unknowns];
        for (int i = 0; i < unknowns; ++i) sharp[i] = SharpComplex(z[i]);
        const Arms<SharpComplex> arms = arms_of(sharp, p);
        for (int j = 0; j < pairs; ++j) {
            const Turns<SharpComplex> turns = turns_of(sharp, p, j);
            const Coefficients<SharpComplex> k = coefficients(arms.p, arms.pc, vectors<0>(sharp, turns));
            out.set(j, of_turn(minors(k, coefficients(arms.q, arms.qc, vectors<1>(sharp, turns)))).rounded());
        }
        if (pairs < unknowns) out.set(pairs, of_last(sharp, p).rounded());
    }

private:
    template <class Number>
    struct Arms {
        Number p, pc, q, qc, k, kc;
    };
    template <class Number>
    struct Turns {
        Number turn[2], back[2];  // of input and output
    };

    template <class Number>
    static Arms<Number> arms_of(const Number* z, const Task& p) {
        const Number &own = z[arm], &own_c = z[arm + 1], k(p.row[3].at(2)), kc(p.row[3].at(3));
        if constexpr (other_arm) return {own, own_c, z[arm + 2], z[arm + 3], k, kc};
        return {own, own_c, k * own, kc * own_c, k, kc};
    }

    bool tilted(int j) const { return pairs == unknowns && j == pairs - 1; }

    template <class Number>
    static Number tilted_turn(const Number* z, const Task& p, int j) {
        return Number(p.row[1].at(j)) - Number(p.row[2].at(0)) * z[0];
    }

    template <class Number>
    Turns<Number> turns_of(const Number* z, const Task& p, int j) const {
        const Number one(Complex{1, 0}), turn(p.row[0].at(j));
        const Number out = tilted(j) ? tilted_turn(z, p, j) : Number(p.row[1].at(j));
        return {{turn, out}, {one / turn, one / out}};
    }

    template <int loop, class Number>
    static LoopVectors<Number> vectors(const Number* z, const Turns<Number>& turns) {
        const Number constant(Complex{static_cast<double>(loops.constant[loop]), 0});
        LoopVectors<Number> l{constant, constant, constant, constant};
        const auto add = [](Number& sum, int sign, const Number& more) { sum = sign > 0 ? sum + more : sum - more; };
        for (int i = 0; i < loops.vectors; ++i) {
            const int sign = loops.sign[loop][i];
            if (sign == 0) continue;
            const Number &own = z[2 * i], &conjugate = z[2 * i + 1];
            const bool turns_not = loops.with[i] == With::nothing;
            const int row = loops.with[i] == With::output ? 1 : 0;
            add(l.w, sign, turns_not ? own : own * turns.turn[row]);
            add(l.wc, sign, turns_not ? conjugate : conjugate * turns.back[row]);
            add(l.first, sign, own);
            add(l.first_c, sign, conjugate);
        }
        return l;
    }

    static void set(Matrix& jacobian, int row, int column, Complex by, Complex by_conjugate) {
        jacobian.column[column].set(row, by);
        jacobian.column[column + 1].set(row, by_conjugate);
    }

    template <class Number>
    static Number of_last(const Number* z, const Task& p) {
        Number value = Number(p.row[3].at(1)) * z[arm] * z[arm + 1] - Number(p.row[3].at(0));
        for (int i = 0; i < unknowns; ++i) value = value + Number(p.row[2].at(i)) * z[i];
        return value;
    }
};

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
