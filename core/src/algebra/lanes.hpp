// Complex numbers side by side: one for each equation, so that a processor takes as many at once as it can.
#pragma once

#include "algebra/complex.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {

template <int lanes>
struct alignas(64) LanesOf {
    double re[lanes], im[lanes];

    Complex at(int i) const { return {re[i], im[i]}; }
    void set(int i, Complex u) {
        re[i] = u.re;
        im[i] = u.im;
    }
    void clear() {
        for (int i = 0; i < lanes; ++i) re[i] = im[i] = 0;
    }
    // Takes a multiple of others away.
    void subtract(Complex k, const LanesOf& v) {
        for (int i = 0; i < lanes; ++i) {
            const Complex less = k * v.at(i);
            re[i] -= less.re;
            im[i] -= less.im;
        }
    }
};

// Equations, one a lane, by the columns of their unknowns.
template <int lanes>
struct MatrixOf {
    LanesOf<lanes> column[lanes];
};

// Gauss with row scaling and pivoting: the x with matrix x = right, for some right sides at once; false for a singular
// matrix. Both are spent. Rows keep their lanes; those that have been pivots are taken no more.
template <int sides, int lanes>
bool solve(MatrixOf<lanes>& matrix, LanesOf<lanes> (&right)[sides], Complex (&x)[sides][lanes]) {
    using Lanes = LanesOf<lanes>;
    constexpr double too_large = 1e300;  // up to it the reciprocal has all digits
    alignas(64) double scale[lanes] = {};
    for (const Lanes& column : matrix.column)
        for (int i = 0; i < lanes; ++i) {
            const double entry = size(column.at(i));
            scale[i] = entry > scale[i] ? entry : scale[i];
        }
    bool fit = true;
    for (int i = 0; i < lanes; ++i) fit &= (scale[i] > 0) & (scale[i] <= too_large);
    if (!fit) return false;
    for (int i = 0; i < lanes; ++i) scale[i] = 1 / scale[i];
    const auto to_one_size = [&scale](Lanes& column) {
        for (int i = 0; i < lanes; ++i) {
            column.re[i] *= scale[i];
            column.im[i] *= scale[i];
        }
    };
    for (Lanes& column : matrix.column) to_one_size(column);
    for (Lanes& side : right) to_one_size(side);

    int row[lanes];                  // the pivots in their order, then the other rows
    alignas(64) double left[lanes];  // 1 for rows that have not been pivots
    Complex inverse[lanes];
    for (int i = 0; i < lanes; ++i) {
        row[i] = i;
        left[i] = 1;
    }
    for (int k = 0; k < lanes; ++k) {
        const Lanes& column = matrix.column[k];
        int pivot = k;
        double largest = 0;
        for (int i = k; i < lanes; ++i) {
            const double entry = size(column.at(row[i]));
            if (entry > largest) {
                largest = entry;
                pivot = i;
            }
        }
        if (!(largest > 0)) return false;
        const int chosen = row[pivot];
        row[pivot] = row[k];
        row[k] = chosen;
        left[chosen] = 0;
        inverse[k] = Complex{1, 0} / column.at(chosen);
        Lanes factor;
        for (int i = 0; i < lanes; ++i) {
            const Complex quotient = column.at(i) * inverse[k];
            factor.re[i] = left[i] * quotient.re;
            factor.im[i] = left[i] * quotient.im;
        }
        for (int c = k + 1; c < lanes; ++c) matrix.column[c].subtract(matrix.column[c].at(chosen), factor);
        for (Lanes& side : right) side.subtract(side.at(chosen), factor);
    }
    for (int k = lanes - 1; k >= 0; --k)
        for (int side = 0; side < sides; ++side) {
            x[side][k] = right[side].at(row[k]) * inverse[k];
            right[side].subtract(x[side][k], matrix.column[k]);
        }
    return true;
}

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
