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
    std::array<int, most_nodes> place;  // node -> place in an order in which critical sets are complete early

    // Reads a graph; false if it has more critical sets than there is room for. Cost: O(2^nodes).
    bool survey(const PackedGraph& graph) {
        nodes = graph.order();
        around.survey(nodes, graph);
        order_nodes();
        list_bundles(graph);
        return list_critical_sets();
    }

    bool holds(Word set, int b) const { return (set >> bundle[b].u & set >> bundle[b].v & 1) != 0; }

private:
    // Set of nodes -> 2 (bundles within) - 3 (nodes) + 3, `rigid` standing for 0: from there on c = 2 breaks the bound.
    std::array<std::uint8_t, 1 << most_nodes> excess_{};
    static constexpr std::uint8_t rigid = 128;

    // Each node has as many neighbours as possible among those before it and else few.
    void order_nodes() {
        const Words& near = around.near;
        Word placed = 0;
        for (int i = 0; i < nodes; ++i) {
            int best = -1, chosen = 0;
            for (int v = 0; v < nodes; ++v) {
                if (placed >> v & 1) continue;
                const int rank = 64 * size(near[v] & placed) + 32 - size(near[v]);
                if (rank > best) {
                    best = rank;
                    chosen = v;
                }
            }
            place[chosen] = i;
            placed |= bit(chosen);
        }
    }

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
        list_excesses();
        sets = 0;
        for (Word first = 0; first < ones(nodes); first += 8) {
            if (none_is_rigid(first)) continue;
            for (Word s = first; s < std::min(first + 8, ones(nodes)); ++s) {
                if (excess_[s] < rigid || size(s) < 3 || has_loose_end(s)) continue;
                if (sets == most_sets) return false;
                critical[sets++] = {s, 3 * size(s) - 4};
            }
        }
        return true;
    }

    bool none_is_rigid(Word first) const {
        unsigned any = 0;
        for (int i = 0; i < 8; ++i) any |= excess_[first + i];
        return any < rigid;
    }

    // The excess is quadratic in the nodes: that of S with both h and k follows from those of S, S + h, S + k.
    void list_excesses() {
        const Words& near = around.near;
        excess_[0] = rigid + 3;
        for (int h = 0; h < nodes; ++h) {
            std::uint8_t* with_h = excess_.data() + (1 << h);
            with_h[0] = static_cast<std::uint8_t>(excess_[0] - 3);
            for (int k = 0; k < h; ++k) {
                const std::uint8_t* with_k = excess_.data() + (1 << k);
                const int joined = 2 * (near[h] >> k & 1);
                for (int s = 0; s < 1 << k; ++s)
                    with_h[(1 << k) + s] = static_cast<std::uint8_t>(with_h[s] + with_k[s] - excess_[s] + joined);
            }
        }
    }

    // Whether a node of the set has fewer than two neighbours in it.
    bool has_loose_end(Word set) const {
        for (Word bits = set; bits != 0; bits = without_lowest(bits))
            if (without_lowest(around.near[lowest(bits)] & set) == 0) return true;
        return false;
    }
};

}  // namespace gruebler::counting
