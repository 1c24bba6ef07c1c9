// The eight equations of four-bars, their derivatives, and how they change on the way from one task to another.
#pragma once

#include "algebra/four_bar.hpp"
#include "algebra/sharp_complex.hpp"
#include "algebra/task.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {

// Numbers of a task: two equations a position, one a point; the rest of the eight fix unknowns. Its rows: displacements
// and their conjugates, of the positions, then of the points; turns g of the positions; the fixed unknowns.
struct Shape {
    int positions = 0;  // besides the first
    int points = 0;
    int equations() const { return 2 * positions + points; }
};

using Lanes = LanesOf<unknowns>;
using Matrix = MatrixOf<unknowns>;
using Task = TaskOf<unknowns>;

inline constexpr Complex one{1, 0};

// The turn of a position and its conjugate.
template <class Number>
Number conjugate_turn(const Number& g) {
    return -g / (Number(one) + g);
}

template <class Number>
Dyad<Number> first_dyad(const Complex* z) {
    return {Number(z[0]), Number(z[1]), Number(z[4]), Number(z[5])};
}

template <class Number>
Dyad<Number> second_dyad(const Complex* z) {
    return {Number(z[2]), Number(z[3]), Number(z[6]), Number(z[7])};
}

// The columns of the unknowns of each dyad.
inline constexpr int first_columns[4] = {0, 1, 4, 5}, second_columns[4] = {2, 3, 6, 7};

// The derivatives by the unknowns, the values of the equations at z, and, if wanted, how fast they change as the task does.
enum class Wanted { values, values_and_rates };

template <Wanted wanted>
void evaluate(const Complex* z, const Task& p, const Task& speed, Shape shape, Matrix& jacobian, Lanes& values,
              Lanes& rates) {
    const auto& [shifts, conjugates, turns, fixed] = p.row;
    constexpr bool with_rates = wanted == Wanted::values_and_rates;
    const Dyad<Complex> first = first_dyad<Complex>(z), second = second_dyad<Complex>(z);
    for (Lanes& column : jacobian.column) column.clear();
    values.clear();
    if (with_rates) rates.clear();
    for (int j = 0; j < shape.positions; ++j) {
        const Complex t = shifts.at(j), s = conjugates.at(j), g = turns.at(j), h = conjugate_turn(g);
        const Coefficients<Complex> turn{g, h, one};
        const auto write = [&](int row, const Dyad<Complex>& dyad, const int* columns) {
            const ByDyad<Complex> by = by_dyad(dyad, t, s, turn);
            jacobian.column[columns[0]].set(row, by.x);
            jacobian.column[columns[1]].set(row, by.xc);
            jacobian.column[columns[2]].set(row, by.a);
            jacobian.column[columns[3]].set(row, by.ac);
            const Coefficients<Complex> k = coefficients(dyad, t, s);
            values.set(row, of_position(k, g, h));
            if constexpr (with_rates) {
                const Complex dg = speed.row[2].at(j), dh = -dg / ((one + g) * (one + g));
                rates.set(row, by_t(dyad, s, turn) * speed.row[0].at(j) + by_s(dyad, t, turn) * speed.row[1].at(j) + k.a * dg +
                                   k.b * dh);
            }
        };
        write(2 * j, first, first_columns);
        write(2 * j + 1, second, second_columns);
    }
    // One iteration a point, none depends on another: a processor does several at once.
    Matrix& __restrict matrix = jacobian;
    Lanes& __restrict value = values;
    Lanes& __restrict rate = rates;
    for (int q = 0; q < shape.points; ++q) {
        const int j = shape.positions + q, row = shape.positions + j;
        const Complex t = shifts.at(j), s = conjugates.at(j);
        const Coefficients<Complex> k = coefficients(first, t, s), l = coefficients(second, t, s);
        const Minors<Complex> m = minors(k, l);
        const Coefficients<Complex> u = by_first(m, l), v = by_second(m, k);
        const ByDyad<Complex> by = by_dyad(first, t, s, u), by_other = by_dyad(second, t, s, v);
        matrix.column[0].set(row, by.x);
        matrix.column[1].set(row, by.xc);
        matrix.column[2].set(row, by_other.x);
        matrix.column[3].set(row, by_other.xc);
        matrix.column[4].set(row, by.a);
        matrix.column[5].set(row, by.ac);
        matrix.column[6].set(row, by_other.a);
        matrix.column[7].set(row, by_other.ac);
        value.set(row, of_point(m));
        if constexpr (with_rates)
            rate.set(row, (by_t(first, s, u) + by_t(second, s, v)) * speed.row[0].at(j) +
                              (by_s(first, t, u) + by_s(second, t, v)) * speed.row[1].at(j));
    }
    for (int r = shape.equations(); r < unknowns; ++r) {
        jacobian.column[r].set(r, one);
        values.set(r, z[r] - fixed.at(r));
        if (with_rates) rates.set(r, -speed.row[3].at(r));
    }
}

// The equations with twice the digits, rounded at the end.
inline void evaluate_sharply(const Complex* z, const Task& p, Shape shape, Lanes& out) {
    const auto& [shifts, conjugates, turns, fixed] = p.row;
    const Dyad<SharpComplex> first = first_dyad<SharpComplex>(z), second = second_dyad<SharpComplex>(z);
    for (int j = 0; j < shape.positions; ++j) {
        const SharpComplex t(shifts.at(j)), s(conjugates.at(j)), g(turns.at(j)), h = conjugate_turn(g);
        out.set(2 * j, of_position(coefficients(first, t, s), g, h).rounded());
        out.set(2 * j + 1, of_position(coefficients(second, t, s), g, h).rounded());
    }
    Lanes& __restrict rest = out;
    for (int q = 0; q < shape.points; ++q) {
        const int j = shape.positions + q;
        const SharpComplex t(shifts.at(j)), s(conjugates.at(j));
        const Coefficients<SharpComplex> k = coefficients(first, t, s), l = coefficients(second, t, s);
        rest.set(shape.positions + j, of_point(minors(k, l)).rounded());
    }
    for (int r = shape.equations(); r < unknowns; ++r) out.set(r, z[r] - fixed.at(r));
}

// The same as a system that a tracker follows.
struct FourBarSystem {
    static constexpr int unknowns = algebra::unknowns;
    Shape shape;

    void evaluate(const Complex* z, const Task& p, Matrix& jacobian, Lanes& values) const {
        Lanes none;
        algebra::evaluate<Wanted::values>(z, p, {}, shape, jacobian, values, none);
    }
    void evaluate_with_rates(const Complex* z, const Task& p, const Task& speed, Matrix& jacobian,
                             Lanes& values, Lanes& rates) const {
        algebra::evaluate<Wanted::values_and_rates>(z, p, speed, shape, jacobian, values, rates);
    }
    void evaluate_sharply(const Complex* z, const Task& p, Lanes& out) const {
        algebra::evaluate_sharply(z, p, shape, out);
    }
};

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
