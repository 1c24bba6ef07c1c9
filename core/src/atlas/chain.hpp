// One chain made ready to be described: a graph whose vertices are the links 0 to n - 1 and, behind them, the multiple
// joints; a joint of two links is an edge, a multiple joint has an edge to each of its links. Definitions:
// docs/theory/atlas.md.
#pragma once

#include <cstdint>
#include <vector>

#include "base/bits.hpp"
#include "labelling/graph_labeller.hpp"

namespace gruebler::atlas {

using bits::Word;

inline constexpr int most_links = 40;      // twice as many as a list of all chains can have; tables of pairs stay small
inline constexpr int most_members = 9;     // links of a joint: their canonical numbers are digits of a word
inline constexpr int most_vertices = 62;   // links and multiple joints: sets of them are bits of a word
inline constexpr int most_joints = most_vertices * (most_vertices - 1) / 2;

struct Joint {
    Word links;
    int kind;  // the place of its pair in the table of pairs
};

struct Chain {
    int links = 0, hubs = 0;
    std::vector<Joint> joints;  // of two links, then multiple ones
    std::vector<Word> near;     // link -> the links that share a joint with it
    labelling::GraphLabeller labeller{most_vertices};

    int vertices() const { return links + hubs; }

    // Takes edges, a link and behind it a link or a multiple joint, with the kinds of their joints, 0 <= kind; false if that
    // is no chain in which every vertex has two edges or more and a joint most_members links at most.
    bool read(int n, std::int64_t multiple, int edges, const std::int32_t* ends, const std::int32_t* kinds);
};

}  // namespace gruebler::atlas
