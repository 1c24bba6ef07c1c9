#include "labelling/labeller.hpp"

#include <utility>

namespace gruebler::labelling {
namespace {

// A plain search that has refined patience * (n + patience) nodes gives way to a thorough one.
constexpr std::int64_t patience = 16;

using Standing = std::strong_ordering;

}  // namespace

Labeller::Labeller(int n)
    : place_of(n),
      orbit_of(n),
      n_(n),
      partition_(n),
      automorphisms_(n),
      levels_(n),
      first_traces_(n),
      best_traces_(n),
      first_leaf_(n),
      best_leaf_(n),
      best_form_(n, best_leaf_),
      level_of_(n),
      local_(n),
      hits_(n) {
    factors.reserve(n);
    candidates_.reserve(n);
    met_.reserve(n);
}

bool Labeller::label(const ColouredGraph& graph, Watch& watch) {
    factors.clear();
    automorphisms_.clear();
    thorough_ = false;
    partition_.begin(graph);
    if (!partition_.is_discrete()) partition_.refine(graph, {});
    if (partition_.is_discrete()) {
        place_of = partition_.place_of;
        for (int v = 0; v < n_; ++v) orbit_of[v] = v;
        return spend(watch, n_ + graph.start[n_]);
    }
    const std::size_t mark = partition_.trail.size();
    End end = search(graph, watch);
    while (end == End::too_long) {
        partition_.undo(mark);
        thorough_ = true;
        end = search(graph, watch);
    }
    for (int i = 0; i < n_; ++i) place_of[best_leaf_[i]] = i;
    for (int v = 0; v < n_; ++v) orbit_of[v] = automorphisms_.orbits.root(v);
    return end == End::done;
}

// Every automorphism found while a node of the first path is at work fixes the vertices singled out above it; when its
// children are done, the orbit of its first child under all automorphisms found so far is the orbit under the stabiliser of
// those vertices, and its length is a factor of the group order.
Labeller::End Labeller::search(const ColouredGraph& graph, Watch& watch) {
    factors.clear();
    automorphisms_.clear();
    for (int v = 0; v < n_; ++v) level_of_[v] = n_;
    int depth = 0;
    for (; !partition_.is_discrete(); ++depth) {
        open(graph, depth, true, Standing::equal);
        Level& level = levels_[depth];
        level.eldest = eldest_child(graph, depth, thorough_, watch);
        if (level.eldest < 0) return End::interrupted;
        level_of_[level.eldest] = depth;
        partition_.single_out(level.eldest);
        first_traces_[depth] = best_traces_[depth] = partition_.refine(graph, {});
        if (!spend(watch, n_ + graph.start[n_])) return End::interrupted;
    }
    first_leaf_ = best_leaf_ = partition_.vertex_at;
    best_form_.change();
    best_is_first_ = true;
    nodes_ = depth;
    for (int k = depth - 1; k >= 0; --k) {
        const int eldest = levels_[k].eldest;
        level_of_[eldest] = n_;
        partition_.undo(levels_[k].mark);
        for (int child = -1; (child = next_root(k, child, eldest, automorphisms_.orbits)) >= 0;) {
            const End end = explore(graph, k, child, watch);
            if (end != End::done) return end;
        }
        factors.push_back(orbit_length(k));
    }
    return End::done;
}

std::int64_t Labeller::orbit_length(int k) {
    Orbits& orbits = automorphisms_.orbits;
    const int least = orbits.root(levels_[k].eldest), target = levels_[k].target;
    std::int64_t length = 0;
    for (int i = target; i < target + partition_.size_of[target]; ++i)
        length += orbits.root(partition_.vertex_at[i]) == least;
    return length;
}

// Searches below one child of the node at level `base` of the first path, and comes back to that node.
//
// Three things cut the search: traces that equal neither those of the first path nor come up to the best ones, an
// automorphism that maps this part of the tree to one searched before, and known automorphisms that map children of a node
// to one another. It ends, with the work unfinished, if it proves too long for a plain one.
Labeller::End Labeller::explore(const ColouredGraph& graph, int base, int child, Watch& watch) {
    levels_[base].follows_first = true;
    levels_[base].standing = Standing::equal;
    int parting = base;  // the level at which the present path leaves the best one
    int k = base;
    while (true) {
        parting = std::min(parting, k);
        Level& level = levels_[k];
        level.vertex = child;
        level_of_[child] = k;
        partition_.single_out(child);
        const Bound bound{level.standing >= 0, level.follows_first, best_traces_[k].early, first_traces_[k].early};
        const Trace trace = partition_.refine(graph, bound);
        if (!spend(watch, n_ + graph.start[n_])) return End::interrupted;
        if (++nodes_ > patience * (n_ + patience) && !thorough_) return End::too_long;
        const bool follows = level.follows_first && trace.whole == first_traces_[k].whole;
        const Standing standing = stand(k, trace);
        int back = k;
        if (follows || standing <= 0) {
            const int matched = jump_back(graph, base, parting, follows, standing);
            if (matched >= 0) {
                back = matched;
            } else if (!partition_.is_discrete()) {
                open(graph, ++k, follows, standing);
                child = levels_[k].eldest = eldest_child(graph, k, standing < 0 && thorough_, watch);
                if (child < 0) return End::interrupted;
                continue;
            } else if (standing < 0 || (standing == 0 && best_form_.follows(graph, partition_))) {
                best_leaf_ = partition_.vertex_at;
                best_form_.change();
                best_is_first_ = false;
                parting = k + 1;
                for (int i = base; i <= k; ++i) levels_[i].standing = Standing::equal;
            }
        }
        k = take_back(k, back);
        while (k > base) {
            child = next_child(k, levels_[k].vertex, levels_[k].eldest);
            if (child >= 0) break;
            k = take_back(k - 1, k - 1);
        }
        if (k == base) return End::done;
    }
}

// How the path stands after this trace; a better trace becomes the best one of its level.
Standing Labeller::stand(int k, const Trace& trace) {
    Standing standing = levels_[k].standing;
    if (standing == 0) standing = trace <=> best_traces_[k];
    if (standing < 0) best_traces_[k] = trace;
    return standing;
}

// The level to go back to if an automorphism maps this node to one searched before, else -1.
int Labeller::jump_back(const ColouredGraph& graph, int base, int parting, bool follows, Standing standing) {
    const auto maps = [&](const std::vector<int>& leaf, int common) {
        return automorphisms_.find(graph, leaf, partition_, levels_[common].mark);
    };
    int common;
    if (follows && maps(first_leaf_, base)) {
        common = base;
    } else if (standing == 0 && !best_is_first_ && maps(best_leaf_, parting)) {
        common = parting;
    } else {
        return -1;
    }
    Orbits& orbits = automorphisms_.orbits;
    const int start = levels_[base].vertex;
    const bool known = orbits.root(start) != start || orbits.root(levels_[base].eldest) == start;
    return known ? base : common;
}

// Begins a node: its cell to take apart is chosen.
void Labeller::open(const ColouredGraph& graph, int k, bool follows, Standing standing) {
    levels_[k].follows_first = follows;
    levels_[k].standing = standing;
    levels_[k].mark = partition_.trail.size();
    levels_[k].target = target_cell(graph, k);
}

// Goes back from a level to one above, to its node before a vertex was singled out there.
int Labeller::take_back(int k, int back) {
    for (int i = back; i <= k; ++i) level_of_[levels_[i].vertex] = n_;
    partition_.undo(levels_[back].mark);
    return back;
}

// Lists the cells of two or more vertices that the latest step with such cells has split, or else all such.
//
// Cells split by the latest steps belong to the part of the graph that has been begun. To finish one part before the next
// is what lets guessed automorphisms come true early.
void Labeller::list_candidates(int k) {
    candidates_.clear();
    const auto& size_of = partition_.size_of;
    for (int upper = k - 1; upper >= 0 && candidates_.empty(); --upper) {
        for (std::size_t t = levels_[upper].mark; t < partition_.trail.size(); ++t) {
            for (const int cell : {partition_.trail[t].born, partition_.trail[t].parent}) {
                if (size_of[cell] < 2 || hits_[cell] != 0) continue;
                hits_[cell] = 1;
                candidates_.push_back(cell);
            }
        }
    }
    for (const int cell : candidates_) hits_[cell] = 0;
    if (!candidates_.empty()) return;
    for (int cell = 0; cell < n_; cell += size_of[cell])
        if (size_of[cell] > 1) candidates_.push_back(cell);
}

// The cells of two or more vertices that a cell is joined to in part.
int Labeller::count_joins(const ColouredGraph& graph, int cell) {
    const auto& size_of = partition_.size_of;
    met_.clear();
    for (int i = cell; i < cell + size_of[cell]; ++i) {
        const int v = partition_.vertex_at[i];
        for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
            const int other = partition_.cell_of[graph.neighbour[e]];
            if (size_of[other] < 2 || other == cell) continue;
            if (hits_[other]++ == 0) met_.push_back(other);
        }
    }
    int joins = 0;
    for (const int other : met_) {
        joins += hits_[other] < static_cast<std::int64_t>(size_of[cell]) * size_of[other];
        hits_[other] = 0;
    }
    return joins;
}

// The cell to take apart: of the candidates one joined in part to most cells, a smallest of such.
//
// Vertices of such cells tell most about the rest. Edges are counted over whole cells, so that the choice is blind to the
// numbers of vertices even where the hashes of the refinement failed to separate a cell.
int Labeller::target_cell(const ColouredGraph& graph, int k) {
    list_candidates(k);
    const auto& size_of = partition_.size_of;
    int best = candidates_[0], widest = 0, most = -1;
    for (const int cell : candidates_) widest = std::max(widest, size_of[cell]);
    if (widest == 2 || candidates_.size() == 1) return best;
    for (const int cell : candidates_) {
        const int joins = count_joins(graph, cell);
        if (joins < most || (joins == most && size_of[cell] >= size_of[best])) continue;
        best = cell;
        most = joins;
    }
    return best;
}

// The least vertex > `last` of the target cell that is the root of its orbit, or -1. The orbit of `eldest`, the child that
// was searched first, counts as done; it is -1 if there is none.
int Labeller::next_root(int k, int last, int eldest, Orbits& orbits) const {
    const int done = eldest >= 0 ? orbits.root(eldest) : -1, target = levels_[k].target;
    int best = -1;
    for (int i = target; i < target + partition_.size_of[target]; ++i) {
        const int v = partition_.vertex_at[i];
        if (v > last && orbits.is_root(v) && v != done && (best < 0 || v < best)) best = v;
    }
    return best;
}

// The next vertex > `last` to single out at a node off the first path, or -1. Of vertices that known automorphisms fixing
// the path to this node map to one another, only the least counts.
int Labeller::next_child(int k, int last, int eldest) {
    const int target = levels_[k].target;
    const auto in_target = [&](int v) { return partition_.cell_of[v] == target; };
    for (int i = target; i < target + partition_.size_of[target]; ++i) local_.isolate(partition_.vertex_at[i]);
    for (const std::vector<Move>& generator : automorphisms_.generators) {
        bool fixes = true, meets = false;
        for (const Move& move : generator) {
            fixes = level_of_[move.from] >= k;
            if (!fixes) break;
            meets |= in_target(move.from);
        }
        if (!fixes || !meets) continue;
        for (const Move& move : generator)
            if (in_target(move.from)) local_.join(move.from, move.to);
    }
    return next_root(k, last, eldest, local_);
}

// The vertex to single out first at a node: the least one or, if children are to be compared, one of the least trace: when
// that comes first, each child of a greater trace falls to one comparison. To be used only where no best path has come yet.
// -1 if the watch ends the work.
int Labeller::eldest_child(const ColouredGraph& graph, int k, bool compare, Watch& watch) {
    const std::size_t mark = partition_.trail.size();
    int best = -1;
    Trace least{~Word{0}, ~Word{0}};
    for (int child = -1; (child = next_child(k, child, -1)) >= 0;) {
        if (!compare) return child;
        partition_.single_out(child);
        const Trace trace = partition_.refine(graph, Bound{true, false, least.early, 0});
        partition_.undo(mark);
        if (!spend(watch, n_ + graph.start[n_])) return -1;
        if (best >= 0 && trace >= least) continue;
        best = child;
        least = trace;
    }
    return best;
}

}  // namespace gruebler::labelling
