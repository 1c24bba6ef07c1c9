#include "structure/sliding.hpp"

#include "base/bits.hpp"

namespace gruebler::structure {
namespace {

using namespace bits;

// The residue of a number up to (prime - 1) prime. That of 2^31 is 1, so the two digits of that base add up; their sum is
// at most 2^32 - 4, and one subtraction is enough.
Residue reduced(Residue value) {
    value = (value & prime) + (value >> 31);
    return value >= prime ? value - prime : value;
}

// By Euclid's algorithm.
Residue inverse(Residue value) {
    std::int64_t a = static_cast<std::int64_t>(value), b = prime, x = 1, y = 0;
    while (b != 0) {
        const std::int64_t q = a / b, rest = a - q * b, next = x - q * y;
        a = b;
        b = rest;
        x = y;
        y = next;
    }
    return static_cast<Residue>(x < 0 ? x + static_cast<std::int64_t>(prime) : x);
}

class Sliding {
public:
    Sliding(const ClosureColumns& chain, int mobility) : chain_(chain), mobility_(mobility) {
        const auto columns = static_cast<std::size_t>(chain.columns), rows = static_cast<std::size_t>(chain.rows);
        basis_.resize(columns * rows);
        factors_.resize(columns * columns);
        levels_.resize(columns);
        left_.resize(columns);
        for (int k = 0; k < chain.columns; ++k) all_joints_ |= bit(static_cast<int>(chain.joint[k]));
        sums_.resize(static_cast<std::size_t>(chain.simple) + 1);
    }

    std::vector<std::int64_t> count(Watch& watch) {
        const std::int64_t steps = chain_.rows * (chain_.columns + 1) / 4 + 1;
        int d = 0;
        while (d >= 0) {
            Level& level = levels_[d];
            take_back(d, level);
            if (++level.chosen == (d < chain_.simple ? 2 : 1)) {
                level.chosen = -1;
                --d;
                continue;
            }
            if (level.chosen == 1) {
                choice_ |= bit(d);
                ++slides_;
            }
            add_column(d, level);
            if (!spend(watch, steps)) return {};
            // with as many solutions as wanted, and one only, a simple joint behind would stay at rest
            if (nulls_ > mobility_ || (nulls_ == mobility_ && mobility_ == 1 && d < chain_.simple - 1)) continue;
            if (d < chain_.columns - 1) {
                ++d;
            } else if (nulls_ == mobility_ && moves_all()) {
                sums_[slides_] += fixing();
            }
        }
        return sums_;
    }

private:
    // A column, as a turning (0) or a sliding one (1).
    struct Level {
        int chosen = -1, pivot = 0;
        bool free = false;      // whether it depends on those before it
        Residue inverse = 0;    // of its pivot, before it was made 1
        Word support = 0;       // the columns of the dependence that it closes
    };

    const ClosureColumns& chain_;
    int mobility_;
    std::vector<Residue> basis_, factors_, left_;  // (column, row); (column, column before): what was taken away; by column
    std::vector<Level> levels_;
    Word all_joints_ = 0, choice_ = 0;
    int nulls_ = 0, slides_ = 0;
    std::vector<std::int64_t> sums_;

    Residue* column(int d) { return basis_.data() + static_cast<std::size_t>(d) * chain_.rows; }
    Residue* factors(int d) { return factors_.data() + static_cast<std::size_t>(d) * chain_.columns; }

    void take_back(int d, const Level& level) {
        if (level.chosen < 0) return;
        nulls_ -= level.free;
        if (level.chosen == 1) {
            choice_ &= ~bit(d);
            --slides_;
        }
    }

    // Reduces a column by those before it.
    void add_column(int d, Level& level) {
        Residue* vector = column(d);
        const std::int64_t* given = chain_.vector(level.chosen, d);
        for (int r = 0; r < chain_.rows; ++r) vector[r] = static_cast<Residue>(given[r]);
        for (int b = 0; b < d; ++b) {
            Residue& factor = factors(d)[b];
            factor = levels_[b].free ? 0 : vector[levels_[b].pivot];
            if (factor == 0) continue;
            const Residue* other = column(b);
            for (int r = 0; r < chain_.rows; ++r) vector[r] = reduced(vector[r] + (prime - factor) * other[r]);
        }
        int at = 0;
        while (at < chain_.rows && vector[at] == 0) ++at;
        level.free = at == chain_.rows;
        if (level.free) {
            ++nulls_;
            level.support = find_support(d);
            return;
        }
        level.pivot = at;
        level.inverse = inverse(vector[at]);
        for (int r = at; r < chain_.rows; ++r) vector[r] = reduced(vector[r] * level.inverse);
    }

    Word find_support(int d) {
        for (int b = 0; b < d; ++b) left_[b] = (prime - factors(d)[b]) % prime;
        Word support = bit(d);
        for (int b = d - 1; b >= 0; --b) {
            if (levels_[b].free || left_[b] == 0) continue;
            support |= bit(b);
            const Residue own = reduced(left_[b] * levels_[b].inverse);
            for (int c = 0; c < b; ++c)
                if (factors(b)[c] != 0) left_[c] = reduced(left_[c] + (prime - own) * factors(b)[c]);
        }
        return support;
    }

    bool moves_all() const {
        Word moving = 0;
        for (const Level& level : levels_) {
            if (!level.free) continue;
            for (Word set = level.support; set != 0; set = without_lowest(set))
                moving |= bit(static_cast<int>(chain_.joint[lowest(set)]));
        }
        return moving == all_joints_;
    }

    // The number of automorphisms that leave the choice as it is.
    std::int64_t fixing() const {
        std::int64_t number = 1;
        for (std::int64_t g = 1; g < chain_.automorphisms; ++g) {
            Word image = 0;
            for (Word set = choice_; set != 0; set = without_lowest(set))
                image |= bit(static_cast<int>(chain_.images[g * chain_.simple + lowest(set)]));
            number += image == choice_;
        }
        return number;
    }
};

}  // namespace

std::vector<std::int64_t> count_sliding(const ClosureColumns& chain, int mobility, Watch& watch) {
    return Sliding(chain, mobility).count(watch);
}

}  // namespace gruebler::structure
