// Packed graphs as they come through a door: any words may stand there.
#pragma once

#include "counting/packed_graph.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {

// Whether every edge stands in both its rows, no vertex is joined to itself, and no row points beyond the last vertex.
inline bool is_consistent(int n, const PackedGraph& graph) {
    for (int v = 0; v < n; ++v) {
        if (graph.field * n < 64 && graph.rows[v] >> (graph.field * n) != 0) return false;
        if (graph.edges(v, v) != 0) return false;
        for (int u = 0; u < v; ++u)
            if (graph.edges(u, v) != graph.edges(v, u)) return false;
    }
    for (int v = n; v < most_nodes; ++v)
        if (graph.rows[v] != 0) return false;
    return true;
}

inline bool is_connected(int n, const PackedGraph& graph) {
    Word reached = 1, fresh = 1;
    while (fresh != 0) {
        const int v = lowest(fresh);
        fresh = without_lowest(fresh);
        for (int u = 0; u < n; ++u) {
            if (graph.edges(u, v) == 0 || (reached >> u & 1)) continue;
            reached |= bit(u);
            fresh |= bit(u);
        }
    }
    return reached == ones(n);
}

// Copies a graph; whether it is a connected one of this number of loops with at least two vertices and all degrees at
// least 3. With at most ten loops it then has at most 18 vertices, 27 edges, 15 edges at a vertex: all tables have room.
inline bool read_graph(const std::uint64_t* words, int width, int loops, PackedGraph& graph) {
    graph = PackedGraph(words, width);
    const int n = graph.order();
    if (n < 2 || !is_consistent(n, graph)) return false;
    int ends = 0;
    for (int v = 0; v < n; ++v) {
        int degree = 0;
        for (int u = 0; u < n; ++u) degree += graph.edges(v, u);
        if (degree < 3) return false;
        ends += degree;
    }
    return ends / 2 - n + 1 == loops && is_connected(n, graph);
}

}  // namespace gruebler::counting
