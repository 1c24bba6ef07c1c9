#include "counting/growth.hpp"

#include <algorithm>
#include <memory>

#include "counting/reading.hpp"
#include "counting/symmetry.hpp"

namespace gruebler::counting {
namespace {

constexpr int most_bundles = 27;                        // pairs of adjacent vertices; edges of ten loops
constexpr int most_places = most_nodes + most_bundles;  // vertices, then bundles

class Growth {
public:
    GrowthEnd grow(const std::uint64_t* words, int width, int loops, std::vector<Words>& children, Watch& watch) {
        if (!read_graph(words, width, loops, parent_)) return GrowthEnd::no_contracted_graph;
        if (!prepare()) return GrowthEnd::too_many_automorphisms;
        const int places = n_ + bundles_;
        for (int p = 0; p < places; ++p) {
            for (int q = p; q < places; ++q) {
                if ((p == q && q < n_) || !is_first(p, q)) continue;
                const bool two_ways = p == q && number_[q - n_] > 1;
                for (int way = 0; way < (two_ways ? 2 : 1); ++way) {
                    const Fate fate = try_child(p, q, way == 0);
                    if (fate == Fate::no_room) return GrowthEnd::too_many_automorphisms;
                    if (fate == Fate::kept) children.push_back(symmetry_.canonical.rows);
                }
            }
            if (!spend(watch, steps_of_a_place)) return GrowthEnd::interrupted;
        }
        return GrowthEnd::done;
    }

private:
    static constexpr std::int64_t steps_of_a_place = 1 << 12;  // of the watch, of some nanoseconds

    enum class Fate { dropped, kept, no_room };

    struct Edge {
        int u, v;

        bool joins(int a, int b) const { return (u == a && v == b) || (u == b && v == a); }
        bool ends_at(int a) const { return u == a || v == a; }
    };

    // The parent: its bundles and their symmetry.
    int n_ = 0, bundles_ = 0, group_ = 0;
    PackedGraph parent_;
    Neighbours around_;
    std::array<Edge, most_bundles> ends_{};
    std::array<int, most_bundles> number_{};     // edges of the bundle
    std::array<bool, most_bundles> removable_{};
    std::array<std::array<int, most_nodes>, most_nodes> bundle_between_{};
    std::array<std::array<int, most_places>, most_automorphisms> images_{};  // (automorphism, place): where it goes

    // The child under trial: its vertices, and the edge just added.
    int h_ = 0;
    Edge added_{};
    PackedGraph child_;
    Neighbours child_around_;
    Words hash_{};
    std::array<Edge, most_bundles> rivals_{};  // other edges that the rule likes as well
    Symmetry symmetry_;

    // What the rule looks at first: the edges between the two ends, then the sum of their degrees.
    static int rank_of(int number, int degrees) { return number * 64 + degrees; }

    // Bundles and automorphisms of the parent; false if there are too many.
    bool prepare() {
        n_ = parent_.order();
        around_.survey(n_, parent_);
        bundles_ = 0;
        for (int v = 0; v < n_; ++v) {
            for (Word before = around_.near[v] & ones(v); before != 0; before = without_lowest(before)) {
                const int u = lowest(before);
                ends_[bundles_] = {u, v};
                number_[bundles_] = parent_.edges(u, v);
                removable_[bundles_] = is_removable(n_, around_.near, parent_, u, v);
                bundle_between_[u][v] = bundle_between_[v][u] = bundles_++;
            }
        }
        group_ = symmetry_.find(n_, around_.near, parent_);
        for (int g = 0; g < group_; ++g) {
            Vertices image{};
            symmetry_.image(n_, g, image);
            for (int v = 0; v < n_; ++v) images_[g][v] = image[v];
            for (int b = 0; b < bundles_; ++b)
                images_[g][n_ + b] = n_ + bundle_between_[image[ends_[b].u]][image[ends_[b].v]];
        }
        return group_ > 0;
    }

    // Whether no automorphism of the parent sends these two places to an earlier pair.
    bool is_first(int p, int q) const {
        for (int g = 1; g < group_; ++g) {
            const auto [a, b] = std::minmax({images_[g][p], images_[g][q]});
            if (a < p || (a == p && b < q)) return false;
        }
        return true;
    }

    // Joins two places by an edge and looks whether the rule prefers it.
    Fate try_child(int p, int q, bool same_edge) {
        const int rank = rank_of_added(p, q, same_edge);
        if (is_outranked(p, q, rank)) return Fate::dropped;
        build(p, q, same_edge);
        const int rivals = find_rivals(rank);
        if (rivals < 0) return Fate::dropped;
        const int group = symmetry_.find(h_, child_around_.near, child_);
        if (group == 0) return Fate::no_room;
        return rivals == 0 || is_preferred(rivals, group) ? Fate::kept : Fate::dropped;
    }

    int rank_of_added(int p, int q, bool same_edge) const {
        const Vertices& degree = around_.degree;
        if (q < n_) return rank_of(parent_.edges(p, q) + 1, degree[p] + degree[q] + 2);
        if (p < n_) return rank_of(ends_[q - n_].ends_at(p) ? 2 : 1, degree[p] + 4);
        return rank_of(p == q && same_edge ? 2 : 1, 6);
    }

    // Whether an old edge that the new one leaves alone is removable and preferred, seen without building. An edge
    // removable before stays removable after an edge is added.
    bool is_outranked(int p, int q, int rank) const {
        for (int b = 0; b < bundles_; ++b) {
            const Edge edge = ends_[b];
            if (!removable_[b] || n_ + b == p || n_ + b == q || (edge.u == p && edge.v == q)) continue;
            int degrees = around_.degree[edge.u] + around_.degree[edge.v];
            if (p < n_ && edge.ends_at(p)) ++degrees;
            if (q < n_ && edge.ends_at(q)) ++degrees;
            if (rank_of(number_[b], degrees) > rank) return true;
        }
        return false;
    }

    // Puts the new vertex on one edge between u and v.
    void halve(int fresh, int u, int v) {
        child_.set_edges(u, v, child_.edges(u, v) - 1);
        child_.set_edges(u, fresh, 1);
        child_.set_edges(fresh, v, 1);
    }

    // A place is a vertex or a bundle, on which a vertex is put first. With p = q a bundle, the two new vertices lie on
    // one of its edges or on two.
    void build(int p, int q, bool same_edge) {
        child_ = parent_;
        child_.make_room(n_ + (p >= n_) + (q >= n_));
        h_ = n_;
        int x = p, y = q;
        if (p >= n_) {
            x = h_++;
            halve(x, ends_[p - n_].u, ends_[p - n_].v);
        }
        if (q >= n_) {
            y = h_++;
            halve(y, p == q && same_edge ? x : ends_[q - n_].u, ends_[q - n_].v);
        }
        child_.set_edges(x, y, child_.edges(x, y) + 1);
        added_ = {x, y};
        child_around_.survey(h_, child_);
    }

    // A word for every vertex of the child that sees two steps far; isomorphic places get equal words.
    void hash_vertices() {
        for (int v = 0; v < h_; ++v) hash_[v] = random_words[child_around_.degree[v] & 255];
        for (int round = 0; round < 2; ++round) {
            Words next{};
            for (int v = 0; v < h_; ++v) {
                Word total = 0;
                for (Word bits = child_around_.near[v]; bits != 0; bits = without_lowest(bits)) {
                    const int u = lowest(bits);
                    const Word mixed = (hash_[u] ^ random_words[child_.edges(u, v)]) * 0x1F58476D1CE4E5B9;
                    total += mixed ^ (mixed >> 29 & ones(35));
                }
                next[v] = hash_[v] * 31 + total;
            }
            hash_ = next;
        }
    }

    // Compared with a sign: the order of the graphs that are listed hangs on it.
    std::int64_t hash_of(Edge edge) const { return static_cast<std::int64_t>(hash_[edge.u] + hash_[edge.v]); }

    // The number of other edges as good as the new one by rank and hash; -1 if one of them is better.
    int find_rivals(int rank) {
        const auto removable = [this](Edge e) { return is_removable(h_, child_around_.near, child_, e.u, e.v); };
        int found = 0;
        for (int v = 0; v < h_; ++v) {
            for (Word before = child_around_.near[v] & ones(v); before != 0; before = without_lowest(before)) {
                const int u = lowest(before), number = child_.edges(u, v);
                if (added_.joins(u, v)) continue;
                const int other = rank_of(number, child_around_.degree[u] + child_around_.degree[v]);
                if (other > rank && removable({u, v})) return -1;
                if (other == rank) rivals_[found++] = {u, v};
            }
        }
        if (found == 0) return 0;
        hash_vertices();
        const std::int64_t hash = hash_of(added_);
        int kept = 0;
        for (int i = 0; i < found; ++i) {
            const Edge edge = rivals_[i];
            if (hash_of(edge) < hash || !removable(edge)) continue;
            if (hash_of(edge) > hash) return -1;
            rivals_[kept++] = edge;
        }
        return kept;
    }

    // Whether the new edge can be carried by an automorphism to the canonically first of its rivals.
    bool is_preferred(int rivals, int group) const {
        const auto& leaves = symmetry_.leaves;
        Vertices place{};
        for (int i = 0; i < h_; ++i) place[leaves[0][i]] = i;
        const auto code = [&place](Edge edge) {
            const auto [first, second] = std::minmax({place[edge.u], place[edge.v]});
            return first * most_nodes + second;
        };
        Edge best = added_;
        for (int i = 0; i < rivals; ++i)
            if (code(rivals_[i]) < code(best)) best = rivals_[i];
        for (int g = 0; g < group; ++g)
            if (best.joins(leaves[g][place[added_.u]], leaves[g][place[added_.v]])) return true;
        return false;
    }
};

}  // namespace

GrowthOutcome add_loop(const GraphRows& parents, int loops, std::int64_t first, std::int64_t enough,
                       std::vector<Words>& children, Watch& watch) {
    const std::unique_ptr<Growth> growth(new Growth);
    for (std::int64_t k = first; k < parents.count; ++k) {
        if (static_cast<std::int64_t>(children.size()) >= enough) return {GrowthEnd::done, k};
        const GrowthEnd end = growth->grow(parents.words + k * parents.width, parents.width, loops, children, watch);
        if (end != GrowthEnd::done) return {end, k};
    }
    return {GrowthEnd::done, parents.count};
}

}  // namespace gruebler::counting
