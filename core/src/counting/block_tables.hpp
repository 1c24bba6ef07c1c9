// Assignments of c to the bundles of one block as bits of words, by what they lack together.
//
// The lack of a bundle is 2 - c, and that of a block is small for almost all that is counted: so its assignments fit a
// word or two. docs/theory/enumeration.md, "Counting without listing".
#pragma once

#include "counting/packed_graph.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {

// Bundles. Seven leave twice as many assignments of the blocks before to go through; nine gain a tenth for 18 links,
// and their tables are five times as large.
inline constexpr int block_width = 8;
inline constexpr int block_lacks = 2 * block_width + 1;
inline constexpr int block_subsets = 1 << block_width;

// (k, lack): how many assignments k bundles have.
inline constexpr auto assignments_of = [] {
    std::array<std::array<int, block_lacks>, block_width + 1> number{};
    number[0][0] = 1;
    for (int k = 1; k <= block_width; ++k)
        for (int lack = 0; lack <= 2 * k; ++lack)
            for (int last = 0; last <= std::min(lack, 2); ++last) number[k][lack] += number[k - 1][lack - last];
    return number;
}();

constexpr int words_of(int width, int lack) {
    return (assignments_of[width][lack] + bits::word_bits - 1) / bits::word_bits;
}

inline constexpr int block_words = words_of(block_width, block_width);  // at most

// What is true of all assignments. They are numbered so that those of fewer bundles come first, the others lacking
// nothing.
class BlockTables {
public:
    using Assignments = std::array<Word, block_words>;

    std::array<std::array<Assignments, block_width + 1>, block_lacks> empty;  // (lack, z): those with z times c = 0
    std::array<std::array<Word, bits::word_bits * block_words>, block_lacks> pattern;  // (lack, assignment): c in unary

    BlockTables() {
        std::array<int, block_lacks> found{};
        Lacks lacks{};
        do {
            int lack = 0;
            for (const int each : lacks) lack += each;
            add(lacks, lack, found[lack]++);
        } while (next(lacks));
        for (int lack = 1; lack < block_lacks; ++lack)
            for (int subset = 0; subset < block_subsets; ++subset)
                for (int part = lack - 1; part > 0; --part) join(lack, subset, part, part + 1);
    }

    // Those of a lack in which the subset lacks `part` at least, 1 <= part <= lack.
    const Word* with(int lack, int subset, int part) const { return with_.data() + at(lack, subset, part); }

private:
    using Lacks = std::array<int, block_width>;

    // Lack by lack, where its rows begin.
    static constexpr auto first_row = [] {
        std::array<int, block_lacks + 1> first{};
        for (int lack = 0; lack < block_lacks; ++lack)
            first[lack + 1] = first[lack] + block_subsets * lack * words_of(block_width, lack);
        return first;
    }();

    std::array<Word, first_row[block_lacks]> with_;

    static constexpr int at(int lack, int subset, int part) {
        return first_row[lack] + (subset * lack + part - 1) * words_of(block_width, lack);
    }

    void add(const Lacks& lacks, int lack, int i) {
        const int word = i / bits::word_bits;
        const Word mark = bit(i % bits::word_bits);
        int zeros = 0;
        Word unary = 0;
        for (int j = 0; j < block_width; ++j) {
            zeros += lacks[j] == 2;
            unary |= ones(2 - lacks[j]) << (2 * j);
        }
        empty[lack][zeros][word] |= mark;
        pattern[lack][i] = unary;
        std::array<int, block_subsets> inside;  // what a subset lacks
        inside[0] = 0;
        for (int subset = 1; subset < block_subsets; ++subset) {
            const int rest = subset & (subset - 1);
            inside[subset] = inside[rest] + lacks[lowest(static_cast<Word>(subset))];
            if (inside[subset] > 0) with_[at(lack, subset, inside[subset]) + word] |= mark;
        }
    }

    // What lacks more in a subset lacks less, too.
    void join(int lack, int subset, int less, int more) {
        for (int w = 0; w < words_of(block_width, lack); ++w)
            with_[at(lack, subset, less) + w] |= with_[at(lack, subset, more) + w];
    }

    static bool next(Lacks& lacks) {
        int j = 0;
        for (; j < block_width && lacks[j] == 2; ++j) lacks[j] = 0;
        if (j < block_width) ++lacks[j];
        return j < block_width;
    }
};

using Assignments = BlockTables::Assignments;

}  // namespace gruebler::counting
