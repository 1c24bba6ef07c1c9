// Contracted graphs with one loop more: loopless two-connected multigraphs, all degrees at least 3.
//
// Every one of them has an edge whose removal, followed by the suppression of vertices of degree 2, leaves such a graph
// with one loop less (the last ear of an ear decomposition). McKay's canonical augmentation turns this into a generator
// without doubles and without memory: a graph is kept when the edge just added lies in the orbit of that removable edge
// of the result which an isomorphism-blind rule prefers.
//
// Theorem and proof: docs/theory/enumeration.md, "Contracted graphs". Source: B. D. McKay, Isomorph-free exhaustive
// generation, J. Algorithms 26 (1998) 306-324.
#pragma once

#include <vector>

#include "base/watch.hpp"
#include "counting/census.hpp"
#include "counting/packed_graph.hpp"

namespace gruebler::counting {

enum class GrowthEnd { done, interrupted, no_contracted_graph, too_many_automorphisms };

struct GrowthOutcome {
    GrowthEnd end;
    std::int64_t next;  // the parent to go on with, or the one at which it ended
};

// Appends the contracted graphs with one loop more that have their canonical parent in a list, in canonical rows, until
// there are `enough` or the list ends. A parent's children stay together.
//
// `parents` are graphs of so many loops, 2 to most_loops - 1, each isomorphism class once; any words may stand there.
// Cost: about 1 us for each graph of nine loops.
GrowthOutcome add_loop(const GraphRows& parents, int loops, std::int64_t first, std::int64_t enough,
                       std::vector<Words>& children, Watch& watch);

}  // namespace gruebler::counting
