// Exact linear algebra over the field of integers modulo the prime 2^31 - 1.
//
// The matrices of mechanisms are sparse and stay so under a good order of elimination, until a dense core is left (for
// chains with many cross-connected loops). The sparse head is eliminated after Markowitz's rule (a short row, in it a
// rare column), the core column by column. Source: H. M. Markowitz, Management Science 3 (1957) 255-269.
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"

namespace gruebler::algebra {

// The largest prime of 31 bits: a product of two residues fits a word.
inline constexpr std::int64_t prime = (std::int64_t{1} << 31) - 1;

// Rows of whole numbers of any size: row i has the entries start[i] to start[i + 1] - 1, each column at most once.
struct SparseRows {
    std::int64_t rows, columns;
    const std::int64_t* start;
    const std::int64_t* column;
    const std::int64_t* value;
};

// Rows in the order of elimination, divided by their pivots. Each knows besides its pivot, which is left out, only
// later pivot columns and free ones, in ascending order.
struct Echelon {
    std::vector<std::int64_t> pivot;
    std::vector<std::int64_t> start{0}, column, value;
};

enum class EliminationEnd { done, interrupted, core_too_large };

struct EliminationOutcome {
    EliminationEnd end;
    std::int64_t core_rows, core_columns;  // of the dense core; 0 if there is none
};

// How large a dense core may be; a larger one is refused before it is begun.
struct MostWork {
    double multiplications, entries;
};

// Cost: linear in practice for chains built dyad by dyad, cubic in the size of the dense core otherwise.
EliminationOutcome eliminate(const SparseRows& matrix, const MostWork& most, Echelon& form, Watch& watch);

// Completes solutions of A x = 0, one a column of an array [columns, width] in which free columns are set; of the other
// rows nothing is read. False if the watch ends the work.
bool solve_back(const Echelon& form, std::int64_t width, std::int64_t* solutions, Watch& watch);

// Brings a dense matrix of residues to reduced row echelon form; `rank` rows are not zero, they come first. False if
// the watch ends the work.
bool reduce(std::int64_t rows, std::int64_t columns, std::int64_t* matrix, std::int64_t& rank, Watch& watch);

}  // namespace gruebler::algebra
