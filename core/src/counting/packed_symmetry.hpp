// The canonical rows and the automorphisms of one packed graph of any number of loops.
#pragma once

#include <cstdint>
#include <vector>

namespace gruebler::counting {

enum class SymmetryEnd { done, no_graph, too_many_automorphisms };

struct GraphSymmetry {
    SymmetryEnd end;
    int vertices = 0;
    std::vector<std::uint64_t> rows;    // canonical, zeros behind, most_nodes in all
    std::vector<std::int64_t> images;   // automorphism by automorphism: where it sends each vertex; the identity first
};

// `words` are the rows of a graph, `width` of them, 1 to most_nodes; any words may stand there.
GraphSymmetry find_symmetry(const std::uint64_t* words, int width);

}  // namespace gruebler::counting
