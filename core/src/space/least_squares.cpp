#include "space/least_squares.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace gruebler::space {
namespace {

// Of the entries from begin to end.
double product(const double* a, const double* b, std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += a[i] * b[i];
    return sum;
}

}  // namespace

LeastSquares::LeastSquares(int rows, int columns) : rows_(rows), columns_(columns) {
    matrix_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    original_.resize(rows > columns ? matrix_.size() : 0);
    factors_.resize(static_cast<std::size_t>(columns)), diagonal_.resize(static_cast<std::size_t>(columns));
    order_.resize(static_cast<std::size_t>(columns));
    row_units_.assign(static_cast<std::size_t>(rows), 1), column_units_.assign(static_cast<std::size_t>(columns), 1);
}

bool LeastSquares::factor(double share) {
    const auto rows = static_cast<std::size_t>(rows_), columns = static_cast<std::size_t>(columns_);
    for (std::size_t k = 0; k < columns; ++k)
        for (std::size_t i = 0; i < rows; ++i) matrix_[k * rows + i] *= column_units_[k] / row_units_[i];
    if (rows > columns) original_ = matrix_;
    mirrors_ = false;
    for (std::size_t k = 0; k < columns; ++k) order_[k] = static_cast<int>(k);
    double first = 0;
    for (std::size_t k = 0; k < columns; ++k) {
        double most = -1;
        std::size_t pivot = k;
        for (std::size_t j = k; j < columns; ++j) {
            const double* a = matrix_.data() + j * rows;
            const double square = product(a, a, k, rows);
            if (square > most) most = square, pivot = j;
        }
        double* a = matrix_.data() + k * rows;
        if (pivot != k) {
            double* b = matrix_.data() + pivot * rows;
            for (std::size_t i = 0; i < rows; ++i) std::swap(a[i], b[i]);
            std::swap(order_[k], order_[pivot]);
            mirrors_ = !mirrors_;
        }
        const double length = std::sqrt(most);
        if (k == 0) first = length;
        if (!(length > share * first)) return false;
        // (1 - f v v^T) a = d e_k with v = a - d e_k, v written over a; the last row of a square matrix needs none.
        double& diagonal = diagonal_[k];
        double& factor = factors_[k];
        if (k + 1 == rows) {
            diagonal = a[k], factor = 0;
            mirrors_ ^= diagonal < 0;
            continue;
        }
        diagonal = a[k] > 0 ? -length : length;
        factor = 1 / (length * (length + std::fabs(a[k])));
        a[k] -= diagonal;
        mirrors_ ^= diagonal > 0;  // the reflection mirrors, too
        for (std::size_t j = k + 1; j < columns; ++j) {
            double* b = matrix_.data() + j * rows;
            const double sum = factor * product(a, b, k, rows);
            for (std::size_t i = k; i < rows; ++i) b[i] -= sum * a[i];
        }
    }
    return true;
}

void LeastSquares::reflect(double* b) const {
    const auto rows = static_cast<std::size_t>(rows_), columns = static_cast<std::size_t>(columns_);
    for (std::size_t k = 0; k < columns; ++k) {
        const double* a = matrix_.data() + k * rows;
        const double sum = factors_[k] * product(a, b, k, rows);
        for (std::size_t i = k; i < rows; ++i) b[i] -= sum * a[i];
    }
}

void LeastSquares::solve(double* b, double* x) const {
    const auto rows = static_cast<std::size_t>(rows_), columns = static_cast<std::size_t>(columns_);
    for (std::size_t i = 0; i < rows; ++i) b[i] /= row_units_[i];
    reflect(b);
    for (std::size_t k = columns; k-- > 0;) {
        const double value = b[k] / diagonal_[k];
        x[order_[k]] = value * column_units_[static_cast<std::size_t>(order_[k])];
        const double* a = matrix_.data() + k * rows;
        for (std::size_t i = 0; i < k; ++i) b[i] -= value * a[i];
    }
}

bool LeastSquares::turns_over(const LeastSquares& other) const {
    if (rows_ == columns_) return mirrors_ != other.mirrors_;
    const auto rows = static_cast<std::size_t>(rows_), columns = static_cast<std::size_t>(columns_);
    LeastSquares seen(columns_, columns_);  // the other one in the directions of the columns of this one
    std::vector<double> column(rows);
    for (std::size_t k = 0; k < columns; ++k) {
        for (std::size_t i = 0; i < rows; ++i) column[i] = other.original_[k * rows + i];
        reflect(column.data());
        for (std::size_t i = 0; i < columns; ++i) seen.matrix_[k * columns + i] = column[i];
    }
    seen.factor(0);
    bool mirrors = seen.mirrors_;
    for (std::size_t k = 0; k < columns; ++k) mirrors ^= diagonal_[k] < 0;
    std::vector<int> order = order_;
    for (std::size_t k = 0; k < columns; ++k)  // the sign of the permutation, by its cycles
        while (order[k] != static_cast<int>(k)) {
            std::swap(order[k], order[static_cast<std::size_t>(order[k])]);
            mirrors = !mirrors;
        }
    return mirrors;
}

}  // namespace gruebler::space
