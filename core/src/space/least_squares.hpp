// Least squares by reflections of Householder with exchanged columns: as many rows as columns or more.
#pragma once

#include <vector>

namespace gruebler::space {

class LeastSquares {
public:
    // Room for matrices of so many rows and columns.
    LeastSquares(int rows, int columns);

    // Written by the caller before `factor`: column k of the matrix begins at `column(k)`.
    double* column(int k) { return matrix_.data() + static_cast<std::size_t>(k) * static_cast<std::size_t>(rows_); }

    // Written by the caller before `factor`: what one of each row and of each column stands for. Pivots are those of the
    // matrix with rows divided and columns multiplied by that; `solve` takes and gives what was not scaled.
    double* row_units() { return row_units_.data(); }
    double* column_units() { return column_units_.data(); }

    // Whether no pivot falls below that share of the first.
    bool factor(double share);

    // The x that makes |A x - b| least; b is changed.
    void solve(double* b, double* x) const;

    // Whether the determinant of the product of the inverse of the matrix and another one, factored too, is negative.
    bool turns_over(const LeastSquares& other) const;

private:
    int rows_, columns_;
    std::vector<double> matrix_, original_, factors_, diagonal_, row_units_, column_units_;
    std::vector<int> order_;
    bool mirrors_ = false;

    void reflect(double* b) const;
};

}  // namespace gruebler::space
