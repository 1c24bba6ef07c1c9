// Chains with multiple joints grown from chains with simple ones.
//
// The tree of docs/theory/multiple-joints.md, "Each chain once": a merging is kept if the split that undoes it is like the
// canonical split of the new chain, and equivalent mergings of a chain count once (B. D. McKay, Isomorph-free exhaustive
// generation, J. Algorithms 26, 1998). Joints are sets of links, as bits.
#pragma once

#include <cstdint>
#include <vector>

#include "base/bits.hpp"
#include "base/watch.hpp"
#include "labelling/graph_labeller.hpp"

namespace gruebler::structure {

using bits::Word;

inline constexpr int most_merged_links = 20;  // a table of a byte for every set of links, at each level

// What is listed: chains with `fewest` to `most` joints of more than two links, none of more than `largest`.
struct JointLimits {
    int fewest, most, largest;
};

// A search that can be interrupted after any chain and gone on with.
class MultipleJoints {
public:
    // `simple`: chains of so many joints one after another, each joint a set of two links; all joints of a chain differ,
    // 2 joints <= 3 (links - 1), and no chain is isomorphic to another.
    MultipleJoints(int links, int joints, std::vector<Word> simple, const JointLimits& limits);

    // Appends rows of 1 + joints numbers until there are so many more or no more chains: the number of the chain of simple
    // joints and the joints, zeros behind. False if the watch ends the work; the search is then over.
    //
    // Cost: some 10 us for a chain of 12 links, and 2^links bytes for each level.
    bool grow(std::int64_t many, std::vector<std::int64_t>& rows, Watch& watch);

private:
    // The joint `big` takes in the other link of a simple joint, which goes: both share the link `kept`.
    struct Merging {
        Word big, small;
        int kept, leaving;
    };

    // A chain on the way, one merging deeper than the level before.
    struct Level {
        std::vector<Word> joints;
        std::vector<Merging> waiting;        // those still to be done
        std::vector<std::int8_t> freedoms;   // set of links -> d
    };

    // Two links of a joint: the split that takes the second one out, leaving it joined to the first.
    struct Split {
        int joint_size, kept, leaving;
    };

    int n_, per_chain_;
    std::vector<Word> simple_;
    JointLimits limits_;
    std::int64_t chain_ = -1;
    int depth_ = -1;
    std::vector<Level> levels_;
    std::vector<Word> near_, merged_;
    std::vector<int> degree_, around_, image_;
    std::vector<Merging> found_;
    std::vector<int> first_;
    labelling::GraphLabeller labeller_;
    labelling::Orbits orbits_;

    void begin_chain();
    void descend();
    bool list_mergings(Watch& watch);
    void list_possible(const Level& level);
    bool keep_one_of_each_orbit(const Level& level, Watch& watch);
    void survey(const std::vector<Word>& joints);
    std::int64_t rank(const Split& split) const;
    int rivals(const std::vector<Word>& joints, const Split& split) const;
    bool label(const std::vector<Word>& joints, Watch& watch);
    bool is_canonical(const std::vector<Word>& joints, const Split& split);
    bool has_room(const Level& level, const Merging& merging) const;
};

}  // namespace gruebler::structure
