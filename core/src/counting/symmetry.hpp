// The canonical rows of a packed graph, and all its automorphisms written out.
//
// Individualisation and refinement (McKay 1981) without any pruning: every leaf of the search is visited, at least as
// many as there are automorphisms. Most of these tiny graphs fall apart at the first refinement.
#pragma once

#include "counting/packed_graph.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {

// Automorphisms there is room for; K(3,6), the most symmetric graph with ten loops, has 4320.
inline constexpr int most_automorphisms = 4320;

// One fixed random word for every (colour, number of edges): the outputs of splitmix64 from state 0.
inline constexpr std::array<Word, 16 * most_nodes> random_words = [] {
    std::array<Word, 16 * most_nodes> words{};
    for (Word i = 1; i <= words.size(); ++i) {
        Word z = i * 0x9E3779B97F4A7C15;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
        words[i - 1] = z ^ (z >> 31);
    }
    return words;
}();

class Symmetry {
public:
    PackedGraph canonical{};                                // degrees falling
    std::array<Vertices, most_automorphisms> leaves{};      // (automorphism, place): the vertex a best leaf puts there

    // Finds the canonical rows and the automorphisms; returns their number, 0 if there is no room for them.
    int find(int n, const Words& near, const PackedGraph& graph) {
        int found = 0, level = 0;
        nodes_[0].cells = refine(n, near, graph, nodes_[0], cells_of_degrees(n, graph));
        bool fresh = true;
        while (level >= 0) {
            Node& node = nodes_[level];
            if (fresh && node.cells == n) {
                const int sign = compare_leaf(n, near, graph, node, found == 0);
                if (sign > 0) found = 0;
                if (sign >= 0) {
                    if (found == most_automorphisms) return 0;
                    for (int i = 0; i < n; ++i) leaves[found][i] = node.order[i];
                    ++found;
                }
                --level;
                fresh = false;
                continue;
            }
            if (fresh) choose_cell(n, node);
            fresh = false;
            if (node.member == node.size) {
                --level;
                continue;
            }
            single_out(n, node, nodes_[level + 1]);
            ++node.member;
            nodes_[level + 1].cells = refine(n, near, graph, nodes_[level + 1], node.cells + 1);
            ++level;
            fresh = true;
        }
        return found;
    }

    // Writes out where automorphism g sends each vertex; returns how many it leaves in place. The first is the identity.
    int image(int n, int g, Vertices& images) const {
        int fixed = 0;
        for (int i = 0; i < n; ++i) {
            images[leaves[0][i]] = leaves[g][i];
            fixed += leaves[0][i] == leaves[g][i];
        }
        return fixed;
    }

private:
    // A node of the search tree: a partition into cells, and the cell whose members are singled out in turn.
    struct Node {
        Vertices colour{};  // vertex -> first place of its cell
        Vertices order{};   // place -> vertex
        int cells = 0, start = 0, size = 0, member = 0;
    };

    std::array<Node, most_nodes + 1> nodes_{};
    Words key_{};

    void sort_by_key(int n, Vertices& order) const {
        for (int i = 1; i < n; ++i) {
            const int v = order[i];
            int j = i;
            for (; j > 0 && key_[order[j - 1]] > key_[v]; --j) order[j] = order[j - 1];
            order[j] = v;
        }
    }

    // Vertices of equal keys become a cell; returns the number of cells.
    int cut(int n, Node& node) const {
        int cells = 1, start = 0;
        for (int i = 0; i < n; ++i) {
            if (i > 0 && key_[node.order[i]] != key_[node.order[i - 1]]) {
                start = i;
                ++cells;
            }
            node.colour[node.order[i]] = start;
        }
        return cells;
    }

    // The largest degree first.
    int cells_of_degrees(int n, const PackedGraph& graph) {
        for (int v = 0; v < n; ++v) {
            int degree = 0;
            for (Word row = graph.rows[v]; row != 0; row >>= graph.field) degree += static_cast<int>(row & ones(graph.field));
            key_[v] = static_cast<Word>(most_nodes * most_parallel - degree);
            nodes_[0].order[v] = v;
        }
        sort_by_key(n, nodes_[0].order);
        return cut(n, nodes_[0]);
    }

    // Splits cells by the colours around each vertex until nothing splits; returns the number of cells.
    //
    // Two neighbourhoods with the same 58-bit sum would stay together; that costs a branch, not the result, since the
    // sum depends on colours and numbers of edges only.
    int refine(int n, const Words& near, const PackedGraph& graph, Node& node, int cells) {
        while (cells < n) {
            for (int v = 0; v < n; ++v) {
                Word total = 0;
                for (Word bits = near[v]; bits != 0; bits = without_lowest(bits)) {
                    const int u = lowest(bits);
                    total += random_words[16 * node.colour[u] + graph.edges(v, u)];
                }
                key_[v] = (static_cast<Word>(node.colour[v]) << 58) | (total >> 6);
            }
            sort_by_key(n, node.order);
            const int found = cut(n, node);
            if (found == cells) break;
            cells = found;
        }
        return cells;
    }

    // The first of the smallest cells with more than one vertex.
    static void choose_cell(int n, Node& node) {
        node.start = -1;
        node.member = 0;
        for (int i = 0; i < n;) {
            int j = i + 1;
            while (j < n && node.colour[node.order[j]] == i) ++j;
            if (j - i > 1 && (node.start < 0 || j - i < node.size)) {
                node.start = i;
                node.size = j - i;
            }
            i = j;
        }
    }

    // The next member of the chosen cell gets a cell of its own, before the others.
    static void single_out(int n, const Node& node, Node& child) {
        const int first = node.start, chosen = first + node.member;
        for (int i = 0; i < n; ++i) {
            child.order[i] = node.order[i];
            child.colour[i] = node.colour[i];
        }
        child.order[chosen] = node.order[first];
        child.order[first] = node.order[chosen];
        for (int i = first + 1; i < first + node.size; ++i) child.colour[child.order[i]] = first + 1;
    }

    // 1, 0, -1 if this leaf writes the graph with greater, the same, smaller rows than the best so far, compared as
    // unsigned words; those of a greater leaf replace the best ones.
    int compare_leaf(int n, const Words& near, const PackedGraph& graph, const Node& leaf, bool first) {
        int sign = first ? 1 : 0;
        Words trial;
        for (int i = 0; i < n; ++i) {
            const int v = leaf.order[i];
            Word row = 0;
            for (Word bits = near[v]; bits != 0; bits = without_lowest(bits)) {
                const int u = lowest(bits);
                row |= static_cast<Word>(graph.edges(v, u)) << (graph.field * leaf.colour[u]);
            }
            trial[i] = row;
            if (sign == 0 && row != canonical.rows[i]) {
                if (row < canonical.rows[i]) return -1;
                sign = 1;
            }
        }
        if (sign > 0) {
            for (int i = 0; i < most_nodes; ++i) canonical.rows[i] = i < n ? trial[i] : 0;
            canonical.field = graph.field;
        }
        return sign;
    }
};

}  // namespace gruebler::counting
