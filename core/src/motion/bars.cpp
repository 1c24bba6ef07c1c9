#include "motion/bars.hpp"

#include <cmath>
#include <utility>

namespace gruebler::motion {
namespace {

// A bar in the Jacobian. A column of both equations of a pin is a vector: how the pin opens along x and y.
class Span {
public:
    Span(const Bar& bar, const double* jacobian, int n) : bar_(bar), jacobian_(jacobian), n_(n) {
        const Complex way = slope(1, bar.column + 2) - slope(0, bar.column + 2);
        length = std::sqrt(dot(way, way));
        across = way / length;
    }

    double length;   // from pin to pin
    Complex across;  // the bar, turned by a quarter
    Complex along() const { return -left(across); }

    Complex slope(int pin, int column) const { return vector(pin, jacobian_ + bar_.row[pin] * n_ + column, n_); }
    Complex open(int pin, const double* target) const { return vector(pin, target + bar_.row[pin], 1); }

private:
    const Bar& bar_;
    const double* jacobian_;
    int n_;

    Complex vector(int pin, const double* first, int stride) const {
        return bar_.sign[pin] * Complex{first[0], first[stride]};
    }
};

}  // namespace

Reduction::Reduction(const Condition* conditions, int count, int bodies) {
    std::vector<Bar> found(bodies);
    std::vector<int> joined(bodies);  // by so many conditions, three if one of them is no pin
    int row = 0;
    for (int c = 0; c < count; ++c) {
        const Condition& one = conditions[c];
        for (const int body : {one.body_a, one.body_b, one.kind == Joint::train ? one.arm : none}) {
            if (body < 0) continue;
            const int pin = joined[body]++;
            if (one.kind != Joint::pin || pin > 1) {
                joined[body] = 3;
                continue;
            }
            found[body].row[pin] = row;
            found[body].sign[pin] = body == one.body_b ? 1 : -1;
        }
        row += equations(one.kind);
    }
    std::vector<int> eliminated(row);
    for (int b = 0; b < bodies; ++b) {
        Bar& bar = found[b];
        bar.column = 3 * b;
        if (joined[b] == 2 && bar.row[0] != bar.row[1] && !eliminated[bar.row[0]] && !eliminated[bar.row[1]]) {
            bars.push_back(bar);
            for (const int first : bar.row) eliminated[first] = eliminated[first + 1] = 1;
        } else {
            for (int k = 0; k < 3; ++k) columns.push_back(3 * b + k);
        }
    }
    for (int k = 0; k < row; ++k)
        if (!eliminated[k]) rows.push_back(k);
}

double factor(double* matrix, int n, int* pivots) {
    double determinant = 1;
    for (int k = 0; k < n; ++k) {
        double* pivot_row = matrix + k * n;
        int best = k;
        for (int i = k + 1; i < n; ++i)
            if (std::fabs(matrix[i * n + k]) > std::fabs(matrix[best * n + k])) best = i;
        pivots[k] = best;
        if (best != k) {
            determinant = -determinant;
            for (int m = 0; m < n; ++m) std::swap(pivot_row[m], matrix[best * n + m]);
        }
        const double pivot = pivot_row[k];
        determinant *= pivot;
        if (pivot == 0) return 0;
        for (int i = k + 1; i < n; ++i) {
            double* row = matrix + i * n;
            if (row[k] == 0) continue;
            const double share = row[k] / pivot;
            row[k] = share;
            for (int m = k + 1; m < n; ++m) row[m] -= share * pivot_row[m];
        }
    }
    return determinant;
}

void solve_factored(const double* matrix, int n, const int* pivots, double* target) {
    for (int k = 0; k < n; ++k)
        if (pivots[k] != k) std::swap(target[k], target[pivots[k]]);
    for (int k = 0; k < n; ++k)
        for (int i = k + 1; i < n; ++i) target[i] -= matrix[i * n + k] * target[k];
    for (int k = n - 1; k >= 0; --k) {
        for (int m = k + 1; m < n; ++m) target[k] -= matrix[k * n + m] * target[m];
        target[k] /= matrix[k * n + k];
    }
}

double factor(const Reduction& reduction, int n, LinearRoom& room) {
    const double* jacobian = room.jacobian.data();
    double lengths = 1, *next = room.factors.data();
    for (const Bar& bar : reduction.bars) {
        const Span span(bar, jacobian, n);
        if (span.length == 0) return 0;
        lengths *= span.length;
        for (const int c : reduction.columns) *next++ = dot(span.along(), span.slope(1, c) - span.slope(0, c));
    }
    for (const int r : reduction.rows)
        for (const int c : reduction.columns) *next++ = jacobian[r * n + c];
    return lengths * factor(room.factors.data(), static_cast<int>(reduction.columns.size()), room.pivots.data());
}

void solve_factored(const Reduction& reduction, int n, LinearRoom& room, double* target) {
    const double* jacobian = room.jacobian.data();
    double *solution = room.solution.data(), *next = solution;
    for (const Bar& bar : reduction.bars) {
        const Span span(bar, jacobian, n);
        *next++ = dot(span.along(), span.open(1, target) - span.open(0, target));
    }
    for (const int r : reduction.rows) *next++ = target[r];
    solve_factored(room.factors.data(), static_cast<int>(reduction.columns.size()), room.pivots.data(), solution);
    for (const Bar& bar : reduction.bars) {
        const Span span(bar, jacobian, n);
        Complex open[2] = {span.open(0, target), span.open(1, target)};
        for (std::size_t k = 0; k < reduction.columns.size(); ++k)
            for (int pin = 0; pin < 2; ++pin) open[pin] -= solution[k] * span.slope(pin, reduction.columns[k]);
        const double turned = dot(span.across, open[1] - open[0]) / span.length;
        const Complex moved = open[0] - turned * span.slope(0, bar.column + 2);
        for (const double number : {moved.x, moved.y, turned}) *next++ = number;
    }
    next = solution;
    for (const int c : reduction.columns) target[c] = *next++;
    for (const Bar& bar : reduction.bars)
        for (int k = 0; k < 3; ++k) target[bar.column + k] = *next++;
}

}  // namespace gruebler::motion
