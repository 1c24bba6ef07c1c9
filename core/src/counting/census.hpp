// All chains of contracted graphs, counted up to symmetry by Burnside's lemma, together with their orbits.
//
// The chains of one contracted graph are the orbits of its automorphisms on string assignments; their number is the mean
// number of assignments that an automorphism leaves as they are. Links, joints and (link, joint at it) are counted in the
// same sum: docs/theory/enumeration.md, "Symmetry".
#pragma once

#include <cstdint>

#include "base/level.hpp"
#include "base/watch.hpp"

namespace gruebler::counting {

inline constexpr int most_loops = 10;     // graphs of 18 nodes: packed_graph.hpp
inline constexpr int most_mobility = 24;  // 64 bits hold what is counted: values.hpp

// Packed graphs one after another, `width` rows each.
struct GraphRows {
    const std::uint64_t* words;
    std::int64_t count;
    int width;
};

struct CensusRow {
    std::int64_t degrees;  // five bits a degree, from 3 on: how many nodes have it
    std::int64_t chains, inversions, joint_orbits, drives;
};

enum class CensusEnd {
    done,
    interrupted,
    no_contracted_graph,       // not a connected graph of this number of loops with degrees of 3 and more
    too_many_sets,             // more critical sets than there is room for
    too_many_automorphisms,
    beyond_64_bits,
    no_whole_number,           // the mean of Burnside's lemma, which would be a fault of the program
};

struct CensusOutcome {
    CensusEnd end;
    std::int64_t graph;  // the one at which it ended
};

// Counts the chains of each contracted graph, with orbits if they are asked for, else 0 stands for them.
//
// 2 <= loops <= most_loops, 0 <= mobility <= most_mobility; `table` has a row for each graph. Any words may stand in the
// graphs: they are looked at first. Cost: about 4 us for each graph and 2 ns for each chain if F = 1.
using TakeCensus = CensusOutcome(const GraphRows& graphs, int loops, int mobility, bool orbits, CensusRow* table,
                                 Watch& watch);

namespace baseline {
TakeCensus take_census;
}
namespace v3 {
TakeCensus take_census;
}
namespace v4 {
TakeCensus take_census;
}

}  // namespace gruebler::counting
