// The number of string assignments that an automorphism of the contracted graph leaves as they are.
//
// The bundles in blocks but the last are gone through as words of bits, a whole block at a time; the last block is not
// searched at all: its assignments are what remains of a few words after a few ANDs, and they are counted.
// Theorems: docs/theory/enumeration.md, "Counting without listing" and "Symmetry".
#pragma once

#include "base/watch.hpp"
#include "counting/blocks.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {

// Sums over the assignments counted: their number, and the classes of binary links, of joints and of (link, joint at it)
// that the automorphism leaves where they are, equal parallel strings being one class.
struct Totals {
    Count found = 0, links = 0, joints = 0, flags = 0;
    double bulk = 0;  // what was found, as a number that cannot overflow
};

// What is counted in one graph.
struct Problem {
    int mobility;
    bool orbits;  // whether to fill all totals
    const Values& values;

    int target(int nodes) const { return 3 * nodes - 3 - mobility; }  // what the sum of c - excess must reach
};

class Counter {
public:
    // False if the watch ends the work.
    bool count(const Problem& problem, const Vertices& image, const Frame& frame, const BlockTables& tables,
               Totals& totals, Watch& watch) {
        const int target = problem.target(frame.nodes), spare = spare_excess(problem.mobility);
        lanes_.arrange(problem.mobility, image, frame);
        lanes_.place_tests(target, problem.mobility, frame, tables);
        search_[0] = Partial{};
        int d = 0;
        while (d >= 0) {
            Partial& now = search_[d];
            if (d == lanes_.variables) {
                const std::int64_t steps = count_blocks(problem, now, target, spare, frame, tables, totals);
                if (!spend(watch, steps)) return false;
                --d;
                continue;
            }
            const Variable& variable = lanes_.variable[d];
            const ValueList& list = problem.values.of_strings[variable.strings];
            if (++now.value == list.size) {
                --d;
            } else if (extend(now, variable, list.classes[now.value], target, spare, frame.bundles, search_[d + 1]) &&
                       passes(lanes_.search_tests[upper][d], search_[d + 1].word) &&
                       passes(lanes_.search_tests[lower][d], ~search_[d + 1].word)) {
                ++d;
            }
        }
        return spend(watch, steps_of_arranging);
    }

private:
    static constexpr std::int64_t steps_of_arranging = 1 << 10;  // of the watch, of some nanoseconds

    // What the first variables have been given.
    struct Partial {
        int value = -1;  // of the next variable
        int sum = 0, excess = 0;  // of c - excess; of the excess
        Word word = 0;  // c in unary
        Count count = 1, links = 0, joints = 0, flags = 0;
    };

    // Where a block stands.
    struct Stage {
        Assignments left;  // not yet tried, of the present lack
        int lack = 0, last_lack = 0;  // of this block
        int current = 0, words = 0;   // the word of `left` to go on with, and their number
        int total = 0;  // of the blocks and the search before
        Word word = 0;  // c in unary, before this block
        Budgets::Row asked;  // of this block and of later ones
    };

    Arrangement lanes_;
    std::array<Partial, most_lanes + 1> search_;
    std::array<Stage, most_blocks> stages_;

    // Whether the next variable can have the value; `next` is then what there is with it.
    static bool extend(const Partial& now, const Variable& variable, const ValueClass& value, int target, int spare,
                       int bundles, Partial& next) {
        const int sum = now.sum + variable.length * (value.cost - value.excess);
        const int excess = now.excess + variable.length * value.excess;
        const int after = bundles - variable.first_lane - variable.length;
        if (excess > spare || sum - (spare - excess) > target || sum + 2 * after < target) return false;
        Word word = now.word;
        const Word unary = ones(std::min(value.cost, 2));
        for (int lane = variable.first_lane; lane < variable.first_lane + variable.length; ++lane)
            word |= unary << (2 * lane);
        const Count many = value.many;
        next = {-1, sum, excess, word, now.count * many, now.links * many, now.joints * many, now.flags * many};
        if (variable.manner == Manner::fixed) {
            next.links += now.count * value.links;
            next.joints += now.count * value.joints;
            next.flags += 2 * now.count * value.joints;
        } else if (variable.manner == Manner::turned) {
            next.links += now.count * value.turned_links;
            next.joints += now.count * value.turned_joints;
        }
        return true;
    }

    static bool passes(const Tests<SearchTest>& tests, Word used) {
        for (const SearchTest& test : tests)
            if (size(used & test.mask) > test.limit) return false;
        return true;
    }

    static Word low_bits(int from, int to) { return ones(2 * to) & ~ones(2 * from) & first_bits; }

    // The first lane in blocks that has a single string; those of several strings stand before it.
    int first_single(const Frame& frame) const {
        int lane = lanes_.searched;
        while (lane < lanes_.last_block().begin && frame.bundle[lanes_.bundle_at[lane]].strings > 1) ++lane;
        return lane;
    }

    // Goes through the blocks for one result of the search; returns the number of steps.
    std::int64_t count_blocks(const Problem& problem, const Partial& found, int target, int all_spare,
                              const Frame& frame, const BlockTables& tables, Totals& totals) {
        const int last = lanes_.blocks - 1, spare = all_spare - found.excess, single = first_single(frame);
        const Word several = low_bits(lanes_.searched, single) << 1;
        const Word singles = low_bits(single, lanes_.last_block().begin);
        std::int64_t steps = 1;
        stages_[0].word = found.word;
        stages_[0].total = found.sum;
        begin_block(0, target, spare, frame.bundles);
        lanes_.budgets.begin(found.word, stages_[0].asked);
        for (int i = 0; i >= 0; ++steps) {
            Stage& now = stages_[i];
            if (i == last) {
                count_last_block(problem, found, target, several, singles, single, frame, tables, totals);
                --i;
                continue;
            }
            const Block& block = lanes_.block[i];
            if (now.current < now.words) {
                Word& left = now.left[now.current];
                if (left == 0) {
                    ++now.current;
                    continue;
                }
                const int chosen = 64 * now.current + lowest(left);
                left = without_lowest(left);
                Stage& next = stages_[++i];
                const Word unary = tables.pattern[now.lack][chosen] & ones(2 * block.width);
                next.word = now.word | unary << (2 * block.begin);
                lanes_.budgets.go_on(i - 1, block.begin, block.width, unary, now.asked, next.asked);
                next.total = now.total + 2 * block.width - now.lack;
                begin_block(i, target, spare, frame.bundles);
                continue;
            }
            if (++now.lack > now.last_lack) {
                --i;
            } else if (allowed(i, now.lack, tables, now.left)) {
                now.current = 0;
                now.words = words_of(block.width, now.lack);
            }
        }
        return steps;
    }

    // What block i can lack: c of all lanes reaches the target, and is more than it by the spare excess at most.
    void begin_block(int i, int target, int spare, int bundles) {
        Stage& now = stages_[i];
        const Block& block = lanes_.block[i];
        const int after = i + 1 < lanes_.blocks ? 2 * (bundles - lanes_.block[i + 1].begin) : 0;
        const int missing = target - now.total;
        now.last_lack = std::min(2 * block.width, 2 * block.width + after - missing);
        now.lack = std::max(0, 2 * block.width - missing - spare) - 1;
        now.current = now.words = 0;
    }

    // Leaves the assignments of a block with this lack that all tests allow; false if one of them allows none at all.
    bool allowed(int i, int lack, const BlockTables& tables, Assignments& left) {
        const Block& block = lanes_.block[i];
        const int words = words_of(block.width, lack);
        for (int w = 0; w < words; ++w) left[w] = block.start[lack][w];
        return lanes_.budgets.each(stages_[i].asked, i, lack, [&](int subset, int part) {
            const Word* row = tables.with(lack, subset, part);
            for (int w = 0; w < words; ++w) left[w] &= row[w];
        });
    }

    // Adds the assignments of the last block after those of all others.
    void count_last_block(const Problem& problem, const Partial& found, int target, Word several, Word singles,
                          int single, const Frame& frame, const BlockTables& tables, Totals& totals) {
        Stage& now = stages_[lanes_.blocks - 1];
        const Block& block = lanes_.last_block();
        const int none = 2 * block.width - (target - now.total);  // lack without excess
        while (++now.lack <= now.last_lack) {
            Assignments left;
            if (!allowed(lanes_.blocks - 1, now.lack, tables, left)) continue;
            const int excess = none - now.lack, words = words_of(block.width, now.lack);
            Count many = 0;
            if (excess == 0) {
                for (int w = 0; w < words; ++w) many += static_cast<Count>(size(left[w]));
            } else {
                many = with_excess(problem.values, excess, left, now.lack, words, size(~now.word & singles), tables);
            }
            if (many == 0) continue;
            const int doubled = size(now.word & several);  // bundles of several strings that stand for two values
            totals.found += (many * found.count) << doubled;
            totals.bulk += static_cast<double>(many) * static_cast<double>(found.count) *
                           static_cast<double>(Count{1} << doubled);
            if (problem.orbits) add_orbits(problem.values, many, excess, found, single, frame, totals);
        }
    }

    // The assignments of the last block, each as often as the excess x falls on the single strings with c = 0: in
    // C(z + x - 1, x) ways on z of them, of which `empty` stand before the block (less those that the block lacks).
    static Count with_excess(const Values& values, int excess, const Assignments& left, int lack, int words, int empty,
                             const BlockTables& tables) {
        Count many = 0;
        for (int z = empty > 0 ? 0 : 1; z <= block_width; ++z) {
            Count both = 0;
            for (int w = 0; w < words; ++w) both += static_cast<Count>(size(left[w] & tables.empty[lack][z][w]));
            many += both * values.ways[empty + z][excess];
        }
        return many;
    }

    // Adds the classes of links, joints and flags of `many` assignments of the last block.
    //
    // They share the excess of single strings, the sum of the block, and what stands before, the word. All bundles in
    // blocks are fixed: single strings have 2 lanes - c + excess binary links together and one joint more for each;
    // bundles of several strings (F = 1, only before the last block) stand for all values of their class.
    void add_orbits(const Values& values, Count many, int excess, const Partial& found, int single, const Frame& frame,
                    Totals& totals) const {
        const Stage& last = stages_[lanes_.blocks - 1];
        Count links = 0, joints = 0, weight = 1;
        for (int lane = lanes_.searched; lane < single; ++lane) {
            const int cost = size(last.word >> (2 * lane) & 3);
            const ValueClass* value = values.of_strings[frame.bundle[lanes_.bundle_at[lane]].strings].begin();
            while (value->cost != cost) ++value;
            links = links * value->many + weight * value->links;
            joints = joints * value->many + weight * value->joints;
            weight *= value->many;
        }
        const int singles = lanes_.last_block().begin + lanes_.last_block().width - single;
        const int c = 2 * lanes_.last_block().width - last.lack + size(last.word & ~ones(2 * single));
        const Count all_links = links + weight * static_cast<Count>(2 * singles - c + excess);
        const Count all_joints = joints + weight * static_cast<Count>(3 * singles - c + excess);
        totals.links += many * (found.links * weight + found.count * all_links);
        totals.joints += many * (found.joints * weight + found.count * all_joints);
        totals.flags += many * (found.flags * weight + 2 * found.count * all_joints);
    }
};

}  // namespace gruebler::counting
