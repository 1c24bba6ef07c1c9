// All assignments of values to the bundles of a contracted graph, symmetry ignored, in lexicographic order.
//
// Every critical set has two budgets: of c within it and, since all c add up to the target at least, of 2 - c outside it.
// The second says nothing new once every bundle has its value, but it ends vain attempts early. A budget is one byte of a
// word, and a byte below 0 ends an attempt. Budgets stand in the order of the last bundles that draw on them: those that no
// later bundle draws on are not looked at again.
#pragma once

#include <algorithm>
#include <vector>

#include "base/watch.hpp"
#include "counting/frame.hpp"

namespace gruebler::counting {

// All values of bundles, by the number of strings, in lexicographic order.
struct AllValues {
    std::array<std::vector<BundleValue>, most_parallel + 1> of_strings;

    AllValues(int most_strings, int mobility, int highest_cost) {
        for (int k = 1; k <= most_strings; ++k)
            each_value({}, k, mobility, highest_cost, [&](const BundleValue& value) { of_strings[k].push_back(value); });
    }
};

class Walk {
public:
    enum class Step { found, over, interrupted };

    int changed = 0;  // the first bundle that has another value than in the assignment before

    // Begins with a graph, before its first assignment.
    void begin(const Frame& frame, const AllValues& values, int mobility) {
        bundles_ = frame.bundles;
        target_ = 3 * frame.nodes - 3 - mobility;
        spare_ = spare_excess(mobility);
        for (int b = 0; b < bundles_; ++b) choices_[b] = &values.of_strings[frame.bundle[b].strings];
        possible_ = set_budgets(frame);
        depth_ = 0;
        changed = 0;
        levels_[0] = {};
    }

    // The number of the value of a bundle, and the value.
    int number(int b) const { return levels_[b].value; }
    const BundleValue& value(int b) const { return (*choices_[b])[levels_[b].value]; }

    // Goes on to the next assignment. `is_hopeless(d)` is asked once on the way, when the first d bundles have their values.
    template <class Question>
    Step next(Watch& watch, const Question& is_hopeless) {
        if (!possible_) return Step::over;
        int d = std::min(depth_, bundles_ - 1);
        changed = d;
        while (d >= 0) {
            Level& now = levels_[d];
            changed = std::min(changed, d);
            if (++now.value == static_cast<int>(choices_[d]->size())) {
                --d;
                continue;
            }
            const BundleValue& value = (*choices_[d])[now.value];
            const int total = now.total + value.cost - value.excess, excess = now.excess + value.excess;
            if (excess > spare_ || total - (spare_ - excess) > target_) continue;
            if (total + 2 * (bundles_ - d - 1) < target_) continue;
            if (overdraws(d, value.cost)) continue;
            if (d == bundles_ - 1) {
                if (total != target_) continue;
                depth_ = bundles_;
                return Step::found;
            }
            if (d == bundles_ - still_open && is_hopeless(d + 1)) continue;
            levels_[++d] = {-1, total, excess};
            if (!spend(watch, steps_of_a_level)) return Step::interrupted;
        }
        possible_ = false;
        return Step::over;
    }

private:
    static constexpr std::int64_t steps_of_a_level = 8;  // of the watch, of some nanoseconds
    static constexpr int still_open = 6;                         // bundles, when the question is asked: measured
    static constexpr int bytes = 8;                              // budgets of a word
    static constexpr int most_words = 2 * most_sets / bytes;
    static constexpr Word overdrawn = 0x8080808080808080;        // the sign bits of its bytes

    struct Level {
        int value = -1;             // of this bundle
        int total = 0, excess = 0;  // of c - excess, of the excess of the bundles before
    };

    using Budgets = std::array<Word, most_words>;

    int bundles_ = 0, target_ = 0, spare_ = 0, words_ = 0, depth_ = 0;
    bool possible_ = false;
    std::array<int, most_lanes> first_word_{};  // bundle -> the first word on which it or a later one draws
    std::array<const std::vector<BundleValue>*, most_lanes> choices_{};
    std::array<Level, most_lanes> levels_{};
    std::array<Budgets, most_lanes + 1> left_{};                     // by depth
    std::array<std::array<Budgets, most_cost + 1>, most_lanes> draws_{};  // (bundle, c): what it takes from each budget

    // Takes the budgets of the next depth; whether one falls below 0.
    bool overdraws(int d, int cost) {
        const Word* before = left_[d].data();
        const Word* draw = draws_[d][cost].data();
        Word* after = left_[d + 1].data();
        Word signs = 0;
        for (int j = first_word_[d]; j < words_; ++j) {
            after[j] = before[j] - draw[j];
            signs |= after[j];
        }
        return (signs & overdrawn) != 0;
    }

    struct Budget {
        Word nodes;
        bool inside;  // whether the bundles inside the set draw on it, with c, or those outside, with 2 - c
        int limit, last;

        bool draws(const Frame& frame, int b) const { return frame.holds(nodes, b) == inside; }
    };

    std::array<Budget, 2 * most_sets> budgets_{};
    int count_ = 0;

    // False if none can hold.
    bool set_budgets(const Frame& frame) {
        count_ = 0;
        for (int i = 0; i < frame.sets; ++i) {
            const auto [nodes, bound] = frame.critical[i];
            int outside = 0;
            for (int b = 0; b < bundles_; ++b) outside += !frame.holds(nodes, b);
            const int limit_outside = 2 * outside - (target_ - bound);
            if (limit_outside < 0) return false;
            add(frame, nodes, true, bound);
            if (limit_outside < 2 * outside) add(frame, nodes, false, limit_outside);
        }
        std::sort(budgets_.begin(), budgets_.begin() + count_, [](const Budget& x, const Budget& y) { return x.last < y.last; });
        words_ = (count_ + bytes - 1) / bytes;
        for (int word = 0; word < words_; ++word) fill(frame, word);
        for (int b = 0, done = 0; b < bundles_; ++b) {
            while (done < count_ && budgets_[done].last < b) ++done;
            first_word_[b] = done / bytes;
        }
        return true;
    }

    void add(const Frame& frame, Word nodes, bool inside, int limit) {
        Budget& budget = budgets_[count_++];
        budget = {nodes, inside, limit, 0};
        for (int b = 0; b < bundles_; ++b)
            if (budget.draws(frame, b)) budget.last = b;
    }

    void fill(const Frame& frame, int word) {
        left_[0][word] = 0;
        for (int b = 0; b < bundles_; ++b)
            for (Budgets& draw : draws_[b]) draw[word] = 0;
        for (int i = word * bytes; i < std::min(count_, (word + 1) * bytes); ++i) {
            const Budget& budget = budgets_[i];
            const int shift = i % bytes * 8;
            left_[0][word] |= static_cast<Word>(budget.limit) << shift;
            for (int b = 0; b < bundles_; ++b) {
                if (!budget.draws(frame, b)) continue;
                for (int cost = 0; cost <= 2; ++cost)
                    draws_[b][cost][word] |= static_cast<Word>(budget.inside ? cost : 2 - cost) << shift;
            }
        }
    }
};

}  // namespace gruebler::counting
