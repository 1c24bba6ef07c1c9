// Elimination modulo a prime without Python, for sanitizers: solutions satisfy every row, the rank is that of the dense
// elimination, and what is too large or interrupted says so.
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "algebra/modular.hpp"
#include "check.hpp"

using namespace gruebler;
using namespace gruebler::algebra;

namespace {

// Rows as a kernel takes them, and the same dense, as residues.
struct Matrix {
    std::int64_t rows, columns;
    std::vector<std::int64_t> start{0}, column{}, value{}, dense{};

    SparseRows sparse() const { return {rows, columns, start.data(), column.data(), value.data()}; }
};

std::int64_t residue(std::int64_t number) { return ((number % prime) + prime) % prime; }

template <class Random>
Matrix random_matrix(std::int64_t rows, std::int64_t columns, double share, Random& random) {
    Matrix matrix{rows, columns};
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    std::uniform_int_distribution<std::int64_t> any(-most, most);
    std::bernoulli_distribution there(share);
    matrix.dense.assign(static_cast<std::size_t>(rows * columns), 0);
    for (std::int64_t i = 0; i < rows; ++i) {
        for (std::int64_t k = 0; k < columns; ++k)
            if (there(random)) {
                matrix.column.push_back(k);
                matrix.value.push_back(any(random));
                matrix.dense[i * columns + k] = residue(matrix.value.back());
            }
        matrix.start.push_back(static_cast<std::int64_t>(matrix.column.size()));
    }
    return matrix;
}

}  // namespace

int main() {
    std::mt19937_64 random(7);
    Watch watch{always, nullptr};
    const MostWork enough{1e12, 1e9};
    std::vector<Matrix> matrices{random_matrix(0, 0, 0, random), random_matrix(3, 0, 0, random),
                                 random_matrix(0, 4, 0, random), random_matrix(4, 5, 0, random)};
    for (const double share : {0.1, 0.3, 1.0})
        for (const std::int64_t columns : {1, 7, 40, 90}) matrices.push_back(random_matrix(45, columns, share, random));
    for (const Matrix& matrix : matrices) {
        Echelon form;
        expect(eliminate(matrix.sparse(), enough, form, watch).end == EliminationEnd::done, "elimination did not end");
        std::vector<std::int64_t> dense = matrix.dense;
        std::int64_t rank = -1;
        expect(reduce(matrix.rows, matrix.columns, dense.data(), rank, watch), "the dense elimination did not end");
        expect(rank == static_cast<std::int64_t>(form.pivot.size()), "sparse and dense rank differ");

        const std::int64_t width = 3;
        std::uniform_int_distribution<std::int64_t> residues(0, prime - 1);
        std::vector<std::int64_t> solutions(static_cast<std::size_t>(matrix.columns * width));
        for (std::int64_t& number : solutions) number = residues(random);
        expect(solve_back(form, width, solutions.data(), watch), "solving back did not end");
        for (std::int64_t i = 0; i < matrix.rows; ++i)
            for (std::int64_t w = 0; w < width; ++w) {
                std::int64_t sum = 0;
                for (std::int64_t k = 0; k < matrix.columns; ++k)
                    sum = (sum + matrix.dense[i * matrix.columns + k] * solutions[k * width + w]) % prime;
                expect(sum == 0, "a solution breaks a row");
            }
    }
    Echelon form;
    const Matrix full = random_matrix(60, 60, 1, random);
    const EliminationOutcome refused = eliminate(full.sparse(), {1, 1}, form, watch);
    expect(refused.end == EliminationEnd::core_too_large, "a core beyond the limit was begun");
    expect(refused.core_rows > 0 && refused.core_columns > 0, "a refused core has no size");
    std::puts("modular: all as it should be");
}
