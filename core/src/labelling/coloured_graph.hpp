// Coloured multigraphs as rows of neighbours.
#pragma once

#include <cstdint>
#include <vector>

namespace gruebler::labelling {

// The edges at vertex v = owner stand at start[v] .. start[v + 1]; every edge stands in two rows. Parallel edges, no loops.
struct ColouredGraph {
    int n = 0;
    const std::int64_t* vertex_colour = nullptr;  // 0 <= colour < 2**31
    std::vector<int> start, owner, neighbour, edge_colour;

    ColouredGraph(int vertices, const std::int64_t* vertex_colours)
        : n(vertices), vertex_colour(vertex_colours), start(static_cast<std::size_t>(vertices) + 1) {}

    int degree(int v) const { return start[v + 1] - start[v]; }

    // Takes m edges, two ends each, and their colours; without colours all have the colour 0.
    void set_edges(std::int64_t m, const std::int32_t* ends, const std::int32_t* colours) {
        start.assign(start.size(), 0);
        owner.resize(2 * m);
        neighbour.resize(2 * m);
        edge_colour.resize(2 * m);
        for (std::int64_t i = 0; i < 2 * m; ++i) ++start[ends[i]];
        int total = 0;
        for (int v = 0; v < n; ++v) start[v] = total += start[v];
        start[n] = total;
        for (std::int64_t i = 0; i < 2 * m; ++i) {
            const int e = --start[ends[i]];
            owner[e] = ends[i];
            neighbour[e] = ends[i ^ 1];
            edge_colour[e] = colours == nullptr ? 0 : colours[i / 2];
        }
    }
};

}  // namespace gruebler::labelling
