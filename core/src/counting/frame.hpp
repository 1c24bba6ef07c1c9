// One contracted graph made ready for counting: bundles in the order of graph6 columns, critical sets of nodes.
//
// An assignment of values is a chain of mobility F if and only if c(S) <= 3|S| - 4 for every proper set S of nodes and
// the sums come out right (docs/theory/enumeration.md, "Strings").
#pragma once

#include "counting/values.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {

inline constexpr int most_sets = 512;  // critical sets there is room for; with eight loops there are at most 99

struct Bundle {
    int u, v;      // u < v
    int strings;
};

struct CriticalSet {
    Word nodes;
    int bound;  // 3|S| - 4
};

struct Frame {
    int nodes = 0, bundles = 0, sets = 0;
    Neighbours around;
    std::array<Bundle, most_lanes> bundle;
    std::array<std::array<int, most_nodes>, most_nodes> bundle_between;
    std::array<CriticalSet, most_sets> critical;

    // Reads a graph; false if it has more critical sets than there is room for. Cost: O(2^nodes).
    bool survey(const PackedGraph& graph) {
        nodes = graph.order();
        around.survey(nodes, graph);
        list_bundles(graph);
        return list_critical_sets();
    }

    bool holds(Word set, int b) const { return (set >> bundle[b].u & set >> bundle[b].v & 1) != 0; }

private:
    std::array<std::uint8_t, 1 << most_nodes> within_;  // set of nodes -> bundles within

    void list_bundles(const PackedGraph& graph) {
        bundles = 0;
        for (int v = 0; v < nodes; ++v) {
            for (Word before = around.near[v] & ones(v); before != 0; before = without_lowest(before)) {
                const int u = lowest(before);
                bundle[bundles] = {u, v, graph.edges(u, v)};
                bundle_between[u][v] = bundle_between[v][u] = bundles++;
            }
        }
    }

    // A set S, |S| >= 3, is critical if its bundles, c = 2 each, could break the bound, and every node of S has at least
    // two neighbours in S; the other sets follow from these.
    bool list_critical_sets() {
        const Words& near = around.near;
        sets = 0;
        within_[0] = 0;
        const Word all = ones(nodes);
        for (Word s = 1; s < all; ++s) {
            const Word rest = without_lowest(s);
            const int within = within_[rest] + size(near[lowest(s)] & rest), bound = 3 * size(s) - 4;
            within_[s] = static_cast<std::uint8_t>(within);
            if (size(s) < 3 || 2 * within <= bound || has_loose_end(s)) continue;
            if (sets == most_sets) return false;
            critical[sets++] = {s, bound};
        }
        return true;
    }

    // Whether a node of the set has fewer than two neighbours in it.
    bool has_loose_end(Word set) const {
        for (Word bits = set; bits != 0; bits = without_lowest(bits))
            if (without_lowest(around.near[lowest(bits)] & set) == 0) return true;
        return false;
    }
};

}  // namespace gruebler::counting
