// Loopless multigraphs of at most 18 vertices in 18 words: one row a vertex, four bits a neighbour, three bits if there are
// more than 16 vertices.
//
// Bits 4u..4u+3 (3u..3u+2) of row v hold the number of edges between u and v, so that a graph is copied, changed and
// compared in a few instructions. Definitions: docs/theory/enumeration.md, "Contracted graphs".
#pragma once

#include <array>
#include <cstdint>

#include "base/bits.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {

using bits::bit, bits::lowest, bits::ones, bits::size, bits::without_lowest, bits::Word;

inline constexpr int most_nodes = 18;       // rows of a word each; three bits a neighbour would do for 21
inline constexpr int most_parallel = 15;    // edges between two vertices: what four bits hold

// The bits of a neighbour in a graph of n vertices.
inline constexpr int field_of(int n) { return n > 16 ? 3 : 4; }

using Words = std::array<Word, most_nodes>;
using Vertices = std::array<int, most_nodes>;

struct PackedGraph {
    Words rows{};
    int field = 4;  // bits a neighbour

    PackedGraph() = default;

    // Words of which those of vertices come first and are not 0.
    PackedGraph(const std::uint64_t* words, int width) {
        for (int v = 0; v < width; ++v) rows[v] = words[v];
        field = field_of(order());
    }

    int edges(int u, int v) const {
        return static_cast<int>(field == 4 ? rows[u] >> (4 * v) & 15 : rows[u] >> (3 * v) & 7);
    }

    void set_edges(int u, int v, int number) {
        set(u, v, number);
        set(v, u, number);
    }

    // Takes the field of n vertices, as many as there are or more; no number of edges is beyond it.
    void make_room(int n) {
        if (field == field_of(n)) return;
        const PackedGraph old = *this;
        field = field_of(n);
        rows = {};
        for (int v = 0; v < old.order(); ++v)
            for (int u = 0; u < v; ++u) set_edges(u, v, old.edges(u, v));
    }

    // The number of vertices: none of them has an empty row.
    int order() const {
        int n = 0;
        while (n < most_nodes && rows[n] != 0) ++n;
        return n;
    }

private:
    void set(int u, int v, int number) {
        rows[u] = (rows[u] & ~(ones(field) << (field * v))) | (static_cast<Word>(number) << (field * v));
    }
};

// For every vertex the set of its neighbours, as bits, and its degree.
struct Neighbours {
    Words near{};
    Vertices degree{};

    void survey(int n, const PackedGraph& graph) {
        for (int v = 0; v < n; ++v) {
            Word bits = 0;
            int total = 0;
            Word row = graph.rows[v];
            for (int u = 0; row != 0; ++u, row >>= graph.field) {
                const Word number = row & ones(graph.field);
                if (number == 0) continue;
                bits |= bit(u);
                total += static_cast<int>(number);
            }
            near[v] = bits;
            degree[v] = total;
        }
    }
};

// Whether a two-connected graph stays so without one of its edges between x and y.
//
// A vertex that then separates the graph lies on every path from x to y: only the vertices of one such path are tried,
// found by way of a common neighbour, or else all of them. Two vertices alone never lose it.
inline bool is_removable(int n, const Words& near, const PackedGraph& graph, int x, int y) {
    if (n == 2 || graph.edges(x, y) > 1) return true;
    const Word around_x = near[x] & ~bit(y), around_y = near[y] & ~bit(x), common = around_x & around_y;
    if (size(common) > 1) return true;
    const Word others = ones(n) & ~(bit(x) | bit(y));
    for (Word suspects = common != 0 ? common : others; suspects != 0; suspects = without_lowest(suspects)) {
        Word seen = bit(lowest(suspects)) | bit(x);
        Word front = around_x & ~seen;
        while (front != 0 && (front & around_y) == 0) {
            seen |= front;
            Word reached = 0;
            for (Word bits = front; bits != 0; bits = without_lowest(bits)) reached |= near[lowest(bits)];
            front = reached & ~seen & ~bit(y);
        }
        if (front == 0) return false;
    }
    return true;
}

}  // namespace gruebler::counting
