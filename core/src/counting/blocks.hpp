// Where the bundles of a contracted graph stand when their values are counted, and which tests they face.
//
// Bundles that the automorphism in question moves are searched, one value for each orbit of them. The others are cut
// into blocks. A critical set leaves of the assignments of a block those in which some of its bundles lack enough: one
// row of a table. c is written in unary, two bits a lane, so that c(S) is one mask and one population count. Theorems:
// docs/theory/enumeration.md, "Strings" and "Counting without listing".
#pragma once

#include "counting/budgets.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {

// How an automorphism treats a bundle.
enum class Manner { moved, fixed, turned };

// An orbit of searched bundles, in lanes that follow each other.
struct Variable {
    int first_lane, length, strings;
    Manner manner;
};

struct Block {
    int begin = 0, width = 0;                          // lanes
    int most_lack = 0;                                 // if no other bundle lacks anything
    std::array<Assignments, block_lacks> start;        // by lack: those that the block alone allows
};

// The lanes of a graph under one automorphism: searched bundles first, then those in blocks.
class Arrangement {
public:
    int variables = 0, searched = 0, blocks = 0;       // orbits, lanes, blocks
    std::array<int, most_lanes> bundle_at{};           // lane -> bundle
    std::array<Variable, most_lanes + 1> variable{};
    std::array<std::array<Tests<SearchTest>, most_lanes>, 2> search_tests;  // (side, variable)
    std::array<Block, most_blocks> block;
    BlockTests block_tests;                            // that ask lanes before the block, too
    Budgets budgets;                                   // of these

    const Block& last_block() const { return block[blocks - 1]; }

    // Searched are orbits of two and more bundles, bundles turned around, and bundles of several strings unless F = 1,
    // where such a bundle differs from a single string only in counting twice for c = 2: these stand in the blocks before
    // the last.
    void arrange(int mobility, const Vertices& image, const Frame& frame) {
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
        clear_tests(mobility, 2 * frame.bundles - target, tables);
        const Word all = ones(2 * frame.bundles), nodes = ones(frame.nodes);
        Words lanes_at{};
        for (int lane = 0; lane < frame.bundles; ++lane)
            for (const int node : {frame.bundle[bundle_at[lane]].u, frame.bundle[bundle_at[lane]].v})
                lanes_at[node] |= Word{3} << (2 * lane);
        for (int i = 0; i < frame.sets; ++i) {
            Word rest = 0;
            for (Word outside = nodes & ~frame.critical[i].nodes; outside != 0; outside = without_lowest(outside))
                rest |= lanes_at[lowest(outside)];
            place_test(all & ~rest, rest, frame.critical[i].bound, target, mobility <= 1, tables);
        }
        budgets.take(blocks, block_tests, frame.bundles);
        for (int i = 0; i < blocks - 1; ++i) budgets.tabulate(i, block[i].begin, block[i].width);
    }

private:
    std::array<int, most_lanes> key_{};

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
            const int a = frame.place[frame.bundle[b].u], z = frame.place[frame.bundle[b].v];
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

    void clear_tests(int mobility, int most_lack, const BlockTables& tables) {
        for (const Side side : {upper, lower}) {
            for (int v = 0; v < variables; ++v) search_tests[side][v].clear();
            for (int i = 0; i < blocks; ++i) block_tests[i][side].clear();
        }
        for (int i = 0; i < blocks; ++i) {
            Block& now = block[i];
            now.most_lack = std::clamp(most_lack, 0, 2 * now.width);
            for (int lack = 0; lack <= now.most_lack; ++lack) {
                const int number = assignments_of[now.width][lack], words = words_of(now.width, lack);
                for (int w = 0; w < words; ++w) {
                    now.start[lack][w] = ~Word{0};
                    if (mobility == 0) now.start[lack][w] = tables.empty[lack][0][w];  // no string has c = 0
                }
                if (number % bits::word_bits != 0) now.start[lack][words - 1] &= ones(number % bits::word_bits);
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
                demand(i, upper, {mask & before, subset, 2 * inside - bound}, tables);
            const int used = size(rest & before), limit = used - (target - bound - 2 * open_rest);
            if (width > inside && open_mask > 0 && limit < used)
                demand(i, lower, {rest & before, subset, 2 * inside - 2 * width - limit + used}, tables);
            before |= ones(2 * width) << (2 * begin);
        }
    }

    // The lanes of a block that are in a mask, one bit each.
    static int lanes_of(Word mask, int begin, int width) {
        Word bits = mask >> (2 * begin) & ones(2 * width) & first_bits;
        bits = (bits | bits >> 1) & 0x3333;
        bits = (bits | bits >> 2) & 0x0f0f;
        return static_cast<int>((bits | bits >> 4) & 0x00ff);
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
        if (test.mask != 0) return block_tests[i][side].add(test);
        Block& now = block[i];
        for (int lack = 0; lack <= now.most_lack; ++lack) {
            const int part = test.need + (side == lower ? lack : 0), words = words_of(now.width, lack);
            if (part > lack) {
                for (int w = 0; w < words; ++w) now.start[lack][w] = 0;
            } else if (part > 0) {
                const Word* row = tables.with(lack, test.subset, part);
                for (int w = 0; w < words; ++w) now.start[lack][w] &= row[w];
            }
        }
    }
};

}  // namespace gruebler::counting
