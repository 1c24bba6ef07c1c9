// Which choices of sliding joints leave a chain movable in all its joints: counted up to symmetry.
//
// Theorem and definitions: docs/theory/joint-types.md.
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"

namespace gruebler::structure {

using Residue = std::uint64_t;

inline constexpr Residue prime = (Residue{1} << 31) - 1;  // a product of two residues fits a word
inline constexpr int most_columns = 62;  // sets of them are bits of a word

// The closure equations of a chain modulo the prime.
struct ClosureColumns {
    int columns, rows, simple;      // the first `simple` columns can be chosen to slide, the others turn
    const std::int64_t* vectors;    // (turning or sliding, column, row): residues
    const std::int64_t* joint;      // column -> its joint, 0 to most_columns - 1
    std::int64_t automorphisms;
    const std::int64_t* images;     // (automorphism, simple column): where it goes; the first moves nothing

    const std::int64_t* vector(int chosen, int column) const { return vectors + (chosen * columns + column) * rows; }
};

// Adds up, for each number of sliding joints, the automorphisms that fix a choice, over all choices whose solutions have
// the dimension `mobility` and move every joint; divided by the number of automorphisms the sums are numbers of orbits
// (Burnside's lemma in the form of a sum over all choices). Empty if the watch ends the work.
//
// All choices are gone through as a tree, column by column, with the columns before it in echelon form. Cost: less than a
// microsecond for each of the 2^simple choices.
std::vector<std::int64_t> count_sliding(const ClosureColumns& chain, int mobility, Watch& watch);

}  // namespace gruebler::structure
