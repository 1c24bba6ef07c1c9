// Whether a chain grows from a single loop by dyads.
#pragma once

#include <vector>

#include "atlas/chain.hpp"
#include "base/watch.hpp"

namespace gruebler::atlas {

inline constexpr int most_remainders = 4096;  // what is left after so many dyads, in all orders

enum class DyadEnd { grows, does_not, too_many, interrupted };

class Dyads {
public:
    // Takes dyads away, one after another, until a single loop is left. All orders are tried; where F = 1 they lead to the
    // same end, so that one order is enough.
    DyadEnd take_away(const Chain& chain, int loops, int mobility, Watch& watch);

private:
    std::vector<Word> before_, after_;  // the links that are left

    static bool is_dyad(const Chain& chain, std::size_t inner, Word alive);
    static bool is_closed(const Chain& chain, Word alive);
};

}  // namespace gruebler::atlas
