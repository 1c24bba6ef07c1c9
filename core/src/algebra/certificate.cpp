#include "algebra/certificate.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "algebra/disc.hpp"
#include "algebra/system.hpp"

namespace gruebler::algebra {
namespace {

// By how much the bound of rounding shrinks with twice the digits: the same operations with 2^-100 instead of 2^-52.
constexpr double sharper = 0x1p-40;
constexpr double steps_in_box = 10;      // the box is so many Newton steps large
constexpr double least_box = 1e-14;      // relative to the unknown
constexpr double sum_of_eight = 2;       // roundings of one operation in a sum of eight products
constexpr double chain_of_sums = 64;     // more than that of all sums of one row of the operator
constexpr std::int64_t work = 1 << 13;   // of one solution in the steps of the watch
constexpr double infinity = std::numeric_limits<double>::infinity();

struct DiscSystem {
    Disc value[unknowns];
    Disc derivative[unknowns][unknowns];
};

void write_row(const ByDyad<Disc>& by, const int* columns, Disc* row) {
    row[columns[0]] = by.x;
    row[columns[1]] = by.xc;
    row[columns[2]] = by.a;
    row[columns[3]] = by.ac;
}

// The equations with discs: they hold the values at all points of the discs z.
void evaluate(const Disc* z, const Task& p, Shape shape, DiscSystem& out) {
    const auto& [shifts, conjugates, turns, fixed] = p.row;
    out = {};
    const Disc one_disc(one);
    const Dyad<Disc> first{z[0], z[1], z[4], z[5]}, second{z[2], z[3], z[6], z[7]};
    for (int j = 0; j < shape.positions; ++j) {
        const Disc t(shifts.at(j)), s(conjugates.at(j)), g(turns.at(j)), h = conjugate_turn(g);
        const Coefficients<Disc> turn{g, h, one_disc};
        out.value[2 * j] = of_position(coefficients(first, t, s), g, h);
        out.value[2 * j + 1] = of_position(coefficients(second, t, s), g, h);
        write_row(by_dyad(first, t, s, turn), first_columns, out.derivative[2 * j]);
        write_row(by_dyad(second, t, s, turn), second_columns, out.derivative[2 * j + 1]);
    }
    for (int j = shape.positions; j < shape.positions + shape.points; ++j) {
        const int row = shape.positions + j;
        const Disc t(shifts.at(j)), s(conjugates.at(j));
        const Coefficients<Disc> k = coefficients(first, t, s), l = coefficients(second, t, s);
        const Minors<Disc> m = minors(k, l);
        out.value[row] = of_point(m);
        write_row(by_dyad(first, t, s, by_first(m, l)), first_columns, out.derivative[row]);
        write_row(by_dyad(second, t, s, by_second(m, k)), second_columns, out.derivative[row]);
    }
    for (int r = shape.equations(); r < unknowns; ++r) {
        out.value[r] = z[r] - Disc(fixed.at(r));
        out.derivative[r][r] = one_disc;
    }
}

struct Inverse {
    Complex entry[unknowns][unknowns];
};

// Nearly the inverse of the centres; false if there is none.
bool invert(const DiscSystem& system, Inverse& inverse) {
    Matrix matrix;
    Lanes units[unknowns];
    Complex columns[unknowns][unknowns];
    for (int k = 0; k < unknowns; ++k) {
        units[k].clear();
        units[k].set(k, one);
        for (int i = 0; i < unknowns; ++i) matrix.column[k].set(i, system.derivative[i][k].centre);
    }
    if (!solve(matrix, units, columns)) return false;
    for (int c = 0; c < unknowns; ++c)
        for (int i = 0; i < unknowns; ++i) inverse.entry[i][c] = columns[c][i];
    return true;
}

struct Box {
    double radius[unknowns];
};

// Whether Krawczyk's operator maps the box about a solution into its interior.
bool maps_into_itself(const Complex* z, const Task& p, Shape shape, bool sharp, Box& box) {
    DiscSystem system;
    Disc unknown[unknowns];
    for (int k = 0; k < unknowns; ++k) {
        unknown[k] = Disc(z[k]);
        box.radius[k] = 0;
    }
    evaluate(unknown, p, shape, system);
    if (sharp) {
        Lanes values;
        evaluate_sharply(z, p, shape, values);
        for (int k = 0; k < unknowns; ++k) {
            Disc& value = system.value[k];
            value = {values.at(k), value.radius * sharper + rounding * modulus(values.at(k))};
        }
    }
    Inverse inverse;
    if (!invert(system, inverse)) return false;
    double step[unknowns];
    for (int i = 0; i < unknowns; ++i) {
        Complex whole;
        double slack = 0;
        for (int j = 0; j < unknowns; ++j) {
            const Disc& value = system.value[j];
            whole = whole + inverse.entry[i][j] * value.centre;
            slack += modulus(inverse.entry[i][j]) * (value.radius + sum_of_eight * rounding * modulus(value.centre));
        }
        step[i] = modulus(whole) + slack;
        box.radius[i] = steps_in_box * step[i] + least_box * modulus(z[i]);
    }
    for (int k = 0; k < unknowns; ++k) unknown[k] = Disc(z[k], box.radius[k]);
    evaluate(unknown, p, shape, system);
    for (int i = 0; i < unknowns; ++i) {
        double mapped = step[i];
        for (int k = 0; k < unknowns; ++k) {
            Complex rest{i == k ? 1.0 : 0.0, 0};
            double spread = 0;
            for (int j = 0; j < unknowns; ++j) {
                const Disc& derivative = system.derivative[j][k];
                rest = rest - inverse.entry[i][j] * derivative.centre;
                spread += modulus(inverse.entry[i][j]) *
                          (derivative.radius + chain_of_sums * rounding * modulus(derivative.centre));
            }
            mapped += (modulus(rest) + spread) * box.radius[k];
        }
        if (!(mapped < box.radius[i] && box.radius[i] < infinity)) return false;
    }
    return true;
}

bool overlap(const Complex* u, const Box& reach, const Complex* v, const Box& other) {
    for (int i = 0; i < unknowns; ++i)
        if (!(modulus(u[i] - v[i]) <= reach.radius[i] + other.radius[i])) return false;
    return true;
}

}  // namespace

bool certify(const Candidates& candidates, Watch& watch) {
    const auto count = static_cast<std::size_t>(candidates.count);
    const Task task = Task::read(candidates.task);
    const Shape shape{candidates.positions, candidates.points};
    std::vector<Complex> z(count * unknowns);
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = {candidates.z[2 * i], candidates.z[2 * i + 1]};
    std::vector<Box> boxes(count);
    for (std::size_t k = 0; k < count; ++k) {
        if (!spend(watch, work)) return false;
        const Complex* here = &z[k * unknowns];
        candidates.proved[k] = maps_into_itself(here, task, shape, false, boxes[k]) ||
                               maps_into_itself(here, task, shape, true, boxes[k]);
    }
    // Boxes that overlap may hold the same solution. From left to right; none reaches farther than the widest.
    std::vector<std::size_t> order;
    double widest = 0;
    for (std::size_t k = 0; k < count; ++k) {
        if (!candidates.proved[k]) continue;
        order.push_back(k);
        widest = std::max(widest, boxes[k].radius[0]);
    }
    const auto left = [&z](std::size_t k) { return z[k * unknowns].re; };
    std::sort(order.begin(), order.end(), [&](std::size_t k, std::size_t l) { return left(k) < left(l); });
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const std::size_t k = order[i], l = order[j];
            if (left(l) - left(k) > boxes[k].radius[0] + widest) break;
            if (!spend(watch, unknowns)) return false;
            if (overlap(&z[k * unknowns], boxes[k], &z[l * unknowns], boxes[l]))
                candidates.proved[k] = candidates.proved[l] = 0;
        }
    return true;
}

void evaluate_equations(const Candidates& candidates, bool sharp, double* values, double* derivatives) {
    const Task task = Task::read(candidates.task), still{};
    const Shape shape{candidates.positions, candidates.points};
    for (std::int64_t k = 0; k < candidates.count; ++k) {
        Complex z[unknowns];
        for (int i = 0; i < unknowns; ++i) {
            const double* number = candidates.z + 2 * (unknowns * k + i);
            z[i] = {number[0], number[1]};
        }
        Matrix matrix;
        Lanes value, none;
        evaluate<Wanted::values>(z, task, still, shape, matrix, value, none);
        if (sharp) evaluate_sharply(z, task, shape, value);
        for (int i = 0; i < unknowns; ++i) {
            *values++ = value.re[i];
            *values++ = value.im[i];
            for (const Lanes& column : matrix.column) {
                *derivatives++ = column.re[i];
                *derivatives++ = column.im[i];
            }
        }
    }
}

}  // namespace gruebler::algebra
