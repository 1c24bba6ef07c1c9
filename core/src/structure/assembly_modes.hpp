// The complex assembly modes of trusses whose joints turn, at almost all dimensions: docs/theory/counting-modes.md.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/bits.hpp"
#include "base/watch.hpp"

namespace gruebler::structure {

inline constexpr int most_mode_links = 21;   // in the plane: tables of all sets of links
inline constexpr int most_mode_joints = 30;  // on the sphere: two marks for each, bits of a word

// A joint is the set of its links, two or more.
using JointSets = std::vector<bits::Word>;

// In the plane: points of a linear space and of the inverse of another one, by a recursion over minors of the matroid of
// links. Memory of many such counts. Cost: 0.3 ms for 11 links, 1.2 ms for 13.
class PlanarModes {
public:
    explicit PlanarModes(int links);

    // 0 if a part is overconstrained; nothing if the watch ends the work.
    std::optional<std::int64_t> count(const JointSets& joints, Watch& watch);

private:
    using Word = bits::Word;
    // What is left of the links once some were contracted in the one matroid (deleted in the other), some the other way.
    struct Minor {
        Word contracted, deleted, ground;
    };
    struct Known {
        std::uint64_t key;
        std::int64_t modes;
    };

    int n_;
    Word all_;
    std::vector<std::uint8_t> rank_;      // of each set of links
    std::vector<std::uint32_t> closure_;  // of each set: all links of the same rank
    std::vector<Known> known_;            // counted minors by open addressing, empty where the key is 0
    std::size_t known_count_ = 0;
    bool stopped_ = false;

    void find_ranks(const JointSets& joints);
    int independent_loops(Word links, const JointSets& joints) const;
    bool fits(Word contracted, Word deleted, Word ground) const;
    std::int64_t count_minor(const Minor& minor, Watch& watch);
    std::int64_t sum_of_splits(const Minor& minor, Watch& watch);
    Known& place_of(std::uint64_t key);
    void make_room();
};

// On the sphere: each joint has two marks on a conic, and the links hold cross-ratios of theirs; one link after another is
// degenerated. Cost: 0.3 ms for 11 links. As for the plane.
std::optional<std::int64_t> count_spherical_modes(int links, const JointSets& joints, Watch& watch);

}  // namespace gruebler::structure
