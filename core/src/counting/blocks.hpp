// Where the bundles of a contracted graph stand when their values are counted, and which tests they face.
//
// Bundles that the automorphism in question moves are searched, one value for each orbit of them. The others are cut into
// blocks of at most seven. The assignments of one block whose c adds up to a given sum are at most 393, hence seven words
// of bits; a critical set leaves of them those with c(X) <= t, X being its bundles in the block and t what everything
// before has left over: one row of a table. c is written in unary, two bits a lane, so that c(S) is one mask and one
// population count. Theorems: docs/theory/enumeration.md, "Strings" and "Counting without listing".
#pragma once

#include "counting/frame.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {

inline constexpr int block_width = 7;  // bundles; with five or six the search before grows more than this saves
inline constexpr int block_sums = 2 * block_width + 1;
inline constexpr int block_subsets = 1 << block_width;
inline constexpr int block_words = 7;  // words that the assignments of one sum fill: 393 bits at most
inline constexpr int most_blocks = 6;  // five hold 31 bundles, and the last may be empty

// Assignments of one block and one sum as bits.
struct alignas(64) Assignments {  // a cache line, of which the last word is not used
    std::array<Word, 8> words{};

    void add(int i) { words[i >> 6] |= bit(i & 63); }

    Assignments& operator&=(const Assignments& other) {
        for (int i = 0; i < block_words; ++i) words[i] &= other.words[i];
        return *this;
    }
};

inline int size(const Assignments& set) {
    int total = 0;
    for (int i = 0; i < block_words; ++i) total += size(set.words[i]);
    return total;
}

inline int size_of_both(const Assignments& a, const Assignments& b) {
    int total = 0;
    for (int i = 0; i < block_words; ++i) total += size(a.words[i] & b.words[i]);
    return total;
}

// What is true of the c of seven bundles, the assignments of each sum numbered with c falling lexicographically.
class BlockTables {
public:
    std::array<std::array<Assignments, block_width + 1>, block_sums> zeros;  // (sum, z): those with z zeros
    std::array<std::array<Word, 64 * block_words>, block_sums> pattern;      // (sum, assignment): c in unary

    BlockTables() {
        std::array<int, block_sums> found{};
        std::array<int, block_width> c;
        c.fill(2);
        do {
            int sum = 0;
            for (const int value : c) sum += value;
            add(c, sum, found[sum]++);
        } while (decrease(c));
    }

    // Those of the sum with c(subset) <= t, t = 0 .. 14.
    const Assignments& allowed(int sum, int subset, int t) const { return allowed_[sum][subset][t]; }

private:
    using Costs = std::array<int, block_width>;

    std::array<std::array<std::array<Assignments, block_sums>, block_subsets>, block_sums> allowed_;

    void add(const Costs& c, int sum, int i) {
        int empty = 0;
        Word unary = 0;
        for (int j = 0; j < block_width; ++j) {
            empty += c[j] == 0;
            unary |= ones(c[j]) << (2 * j);
        }
        zeros[sum][empty].add(i);
        pattern[sum][i] = unary;
        for (int subset = 0; subset < block_subsets; ++subset) {
            int inside = 0;
            for (int j = 0; j < block_width; ++j) inside += (subset >> j & 1) * c[j];
            for (int t = inside; t < block_sums; ++t) allowed_[sum][subset][t].add(i);
        }
    }

    static bool decrease(Costs& c) {
        int j = block_width - 1;
        for (; j >= 0 && c[j] == 0; --j) c[j] = 2;
        if (j >= 0) --c[j];
        return j >= 0;
    }
};

// How an automorphism treats a bundle.
enum class Manner { moved, fixed, turned };

// An orbit of searched bundles, in lanes that follow each other.
struct Variable {
    int first_lane, length, strings;
    Manner manner;
};

// c(masked lanes) <= limit.
struct SearchTest {
    Word mask;
    int limit;
};

// c(subset of the block) <= limit - c(masked lanes, before the block); says nothing from `trivial_from` on. A lower test
// counts what is left over of 2 a lane instead of what is used, and its limit rises with the sum of the block.
struct BlockTest {
    Word mask;
    int subset, limit, trivial_from;
};

template <class Test>
class Tests {
public:
    void clear() { size_ = 0; }
    void add(const Test& test) { tests_[size_++] = test; }
    const Test* begin() const { return tests_.data(); }
    const Test* end() const { return tests_.data() + size_; }

private:
    int size_ = 0;
    std::array<Test, most_sets> tests_;  // one of a critical set at most
};

// Whether a test is about what is used (c within the set) or what is left over (2 - c outside it).
enum Side { upper = 0, lower = 1 };

struct Block {
    int begin = 0, width = 0;                          // lanes
    std::array<Assignments, block_sums> start;         // by sum: those that the block alone allows
    std::array<Tests<BlockTest>, 2> tests;             // by side
};

// The lanes of a graph under one automorphism: searched bundles first, then those in blocks.
class Arrangement {
public:
    int variables = 0, searched = 0, blocks = 0;       // orbits, lanes, blocks
    std::array<int, most_lanes> bundle_at{};           // lane -> bundle
    std::array<Variable, most_lanes + 1> variable{};
    std::array<std::array<Tests<SearchTest>, most_lanes>, 2> search_tests;  // (side, variable)
    std::array<Block, most_blocks> block;

    const Block& last_block() const { return block[blocks - 1]; }

    // Searched are orbits of two and more bundles, bundles turned around, and bundles of several strings unless F = 1,
    // where such a bundle differs from a single string only in counting twice for c = 2: these stand in the blocks before
    // the last.
    void arrange(int mobility, const Vertices& image, const Frame& frame) {
        order_nodes(frame);
        const Word seen = find_orbits(mobility, image, frame);
        const int several = line_up(seen, frame);
        cut_blocks(frame.bundles, several);
    }

    // Turns every critical set into tests of the search and of blocks.
    //
    // All c add up to T, T >= target, and to the target itself if F <= 1. So c(S) <= b demands that c(rest) >= target - b.
    // If F <= 1 the two are the same, and whichever of S and the rest is complete first decides; until then both must
    // still be possible.
    void place_tests(int target, int mobility, const Frame& frame, const BlockTables& tables) {
        clear_tests(mobility, tables);
        for (int i = 0; i < frame.sets; ++i) {
            Word mask = 0;
            for (int lane = 0; lane < frame.bundles; ++lane)
                if (frame.holds(frame.critical[i].nodes, bundle_at[lane])) mask |= Word{3} << (2 * lane);
            place_test(mask, ones(2 * frame.bundles) & ~mask, frame.critical[i].bound, target, mobility <= 1, tables);
        }
    }

private:
    std::array<int, most_lanes> key_{};
    std::array<int, most_nodes> place_{};  // node -> place in the order of nodes

    // Each node has as many neighbours as possible among those before it and else few: so critical sets are complete
    // early.
    void order_nodes(const Frame& frame) {
        const Words& near = frame.around.near;
        Word placed = 0;
        for (int i = 0; i < frame.nodes; ++i) {
            int best = -1, chosen = 0;
            for (int v = 0; v < frame.nodes; ++v) {
                if (placed >> v & 1) continue;
                const int rank = 64 * size(near[v] & placed) + 32 - size(near[v]);
                if (rank > best) {
                    best = rank;
                    chosen = v;
                }
            }
            place_[chosen] = i;
            placed |= bit(chosen);
        }
    }

    // Gives lanes to the searched bundles, returned as bits.
    Word find_orbits(int mobility, const Vertices& image, const Frame& frame) {
        Word seen = 0;
        int lane = 0;
        variables = 0;
        for (int b = 0; b < frame.bundles; ++b) {
            const auto [u, v, strings] = frame.bundle[b];
            const bool fixed = image[u] == u && image[v] == v;
            if ((seen >> b & 1) || (fixed && (strings == 1 || mobility == 1))) continue;
            Variable& orbit = variable[variables++];
            orbit.first_lane = lane;
            orbit.strings = strings;
            for (int c = b; !(seen >> c & 1); c = frame.bundle_between[image[frame.bundle[c].u]][image[frame.bundle[c].v]]) {
                seen |= bit(c);
                bundle_at[lane++] = c;
            }
            orbit.length = lane - orbit.first_lane;
            orbit.manner = orbit.length > 1 ? Manner::moved : fixed ? Manner::fixed : Manner::turned;
        }
        searched = lane;
        return seen;
    }

    // Gives lanes to the others, those of several strings first, and returns how many these are.
    int line_up(Word seen, const Frame& frame) {
        constexpr int single = 32 * most_nodes * 2;  // beyond every rank by place
        int lane = searched, several = 0;
        for (int b = 0; b < frame.bundles; ++b) {
            if (seen >> b & 1) continue;
            const int a = place_[frame.bundle[b].u], z = place_[frame.bundle[b].v];
            int rank = std::max(a, z) * 32 + std::min(a, z);
            if (frame.bundle[b].strings > 1) {
                ++several;
            } else {
                rank += single;
            }
            int j = lane++;
            for (; j > searched && key_[j - 1] > rank; --j) {
                key_[j] = key_[j - 1];
                bundle_at[j] = bundle_at[j - 1];
            }
            key_[j] = rank;
            bundle_at[j] = b;
        }
        return several;
    }

    void cut_blocks(int bundles, int several) {
        const int last = std::min(block_width, bundles - searched - several);
        const int rest = bundles - searched - last, before = (rest + block_width - 1) / block_width;
        int lane = searched;
        for (int i = 0; i < before; ++i) {
            block[i].begin = lane;
            block[i].width = i == 0 ? rest - block_width * (before - 1) : block_width;
            lane += block[i].width;
        }
        block[before].begin = lane;
        block[before].width = last;
        blocks = before + 1;
    }

    void clear_tests(int mobility, const BlockTables& tables) {
        for (const Side side : {upper, lower}) {
            for (int v = 0; v < variables; ++v) search_tests[side][v].clear();
            for (int i = 0; i < blocks; ++i) block[i].tests[side].clear();
        }
        for (int i = 0; i < blocks; ++i) {
            const int missing = block_width - block[i].width;
            const int absent = (block_subsets - 1) & ~((1 << block[i].width) - 1);
            for (int s = 0; s < block_sums; ++s) {
                block[i].start[s] = tables.allowed(s, absent, 0);
                if (mobility == 0) block[i].start[s] &= tables.zeros[s][missing];  // no string has c = 0
            }
        }
    }

    void place_test(Word mask, Word rest, int bound, int target, bool exact, const BlockTables& tables) {
        Word before = ones(2 * searched);
        int open_mask = size(mask & ~before) / 2, open_rest = size(rest & ~before) / 2;  // lanes not yet complete
        demand_of_search(upper, mask & before, bound);
        demand_of_search(lower, rest & before, size(rest & before) - (target - bound - 2 * open_rest));
        for (int i = 0; i < blocks; ++i) {
            if (open_mask == 0 || (exact && open_rest == 0)) break;
            const int begin = block[i].begin, width = block[i].width;
            const int subset = lanes_of(mask, begin, width), inside = size(static_cast<Word>(subset));
            open_mask -= inside;
            open_rest -= width - inside;
            if (inside > 0 && size(mask & before) + 2 * inside > bound && (open_rest > 0 || open_mask == 0 || !exact))
                demand(i, upper, {mask & before, subset, bound, 2 * inside}, tables);
            const int used = size(rest & before), limit = used - (target - bound - 2 * open_rest);
            if (width > inside && open_mask > 0 && limit < used)
                demand(i, lower, {rest & before, subset, limit, 2 * inside}, tables);
            before |= ones(2 * width) << (2 * begin);
        }
    }

    // The lanes of a block that are in a mask, one bit each.
    static int lanes_of(Word mask, int begin, int width) {
        int subset = 0;
        for (int j = 0; j < width; ++j) subset |= static_cast<int>(mask >> (2 * (begin + j)) & 1) << j;
        return subset;
    }

    // A test of the search is due at the last variable that has a lane of it.
    void demand_of_search(Side side, Word part, int limit) {
        if (part == 0 || size(part) <= limit) return;
        int last = variables - 1;
        while (part >> (2 * variable[last].first_lane) == 0) --last;
        search_tests[side][last].add({part, limit});
    }

    // A test of a block that looks at nothing before it is made at once.
    void demand(int i, Side side, const BlockTest& test, const BlockTables& tables) {
        if (test.mask != 0) return block[i].tests[side].add(test);
        for (int s = 0; s < block_sums; ++s) {
            const int t = test.limit + (side == lower ? s : 0);
            if (t < 0) {
                block[i].start[s] = Assignments{};
            } else if (t < block_sums - 1) {
                block[i].start[s] &= tables.allowed(s, test.subset, t);
            }
        }
    }
};

}  // namespace gruebler::counting
