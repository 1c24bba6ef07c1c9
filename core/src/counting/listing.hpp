// Chains written out: one representative of every orbit of string assignments, as edges or as graph6.
//
// The representative is the assignment that is lexicographically least among its images under the automorphisms of the
// contracted graph; assignments come in lexicographic order, so no memory of earlier ones is needed (orderly generation;
// R. C. Read, Every one a winner, Ann. Discrete Math. 2 (1978) 107-120).
#pragma once

#include <vector>

#include "base/watch.hpp"
#include "counting/census.hpp"

namespace gruebler::counting {

// Edges: two bytes a joint, its links. The links of a chain are the nodes of its contracted graph and then the binary
// links, string by string in the order of bundles. Lines: graph6 with the same numbers of links.
enum class Form { edges, lines };

enum class ListEnd { done, interrupted, no_contracted_graph, too_many_sets, too_many_automorphisms };

struct ListOutcome {
    ListEnd end;
    std::int64_t graph;  // the one at which it ended
};

inline int links_of(int loops, int mobility) { return 2 * loops + 1 + mobility; }
inline int joints_of(int loops, int mobility) { return 3 * loops + mobility; }

// Appends the chains of contracted graphs, all of one length.
//
// 2 <= loops <= most_loops, 0 <= mobility <= most_mobility. Any words may stand in the graphs: they are looked at first.
// Cost: about 100 ns for each chain.
ListOutcome list_chains(const GraphRows& graphs, int loops, int mobility, Form form, std::vector<std::uint8_t>& bytes,
                        Watch& watch);

}  // namespace gruebler::counting
