#include "labelling/partition.hpp"

#include <bit>

namespace gruebler::labelling {
namespace {

// Rounds of colour refinement done for all vertices at once before cells exist. Two, after the degrees, separate most of
// what can be separated in graphs of a few dozen vertices; more cost more than they save.
constexpr int rounds = 2;

// After so many splitting cells a refinement asks, once, whether it can still matter.
constexpr int early_steps = 8;

}  // namespace

Partition::Partition(int n)
    : vertex_at(n), place_of(n), cell_of(n), size_of(n), n_(n), key_(n), sum_(n), keyed_(n), hits_(n), waits_(n), splitter_(n) {
    trail.reserve(n);
    waiting_.reserve(n);
    touched_.reserve(n);
}

// For every vertex a key: its colour, then a hash of what is near.
void Partition::hash_surroundings(const ColouredGraph& graph) {
    const int ends = graph.start[n_];
    weight_.resize(ends);
    std::int64_t last = -1;
    Word weight = 0;
    for (int e = 0; e < ends; ++e) {
        if (graph.edge_colour[e] != last) {
            last = graph.edge_colour[e];
            weight = mix(static_cast<Word>(last)) | 1;
        }
        weight_[e] = weight;
    }
    std::int64_t top = 0;
    for (int v = 0; v < n_; ++v) {
        top = std::max(top, graph.vertex_colour[v]);
        key_[v] = mix(static_cast<Word>(graph.vertex_colour[v]) * mixer + static_cast<Word>(graph.degree(v)));
    }
    for (int round = 0; round < rounds; ++round) {  // edge by edge: how many stand at a vertex cannot be guessed
        for (int v = 0; v < n_; ++v) {
            sum_[v] = key_[v];
            key_[v] *= golden;
        }
        for (int e = 0; e < ends; ++e) key_[graph.owner[e]] += weight_[e] * sum_[graph.neighbour[e]];
        for (int v = 0; v < n_; ++v) key_[v] = mix(key_[v]);
    }
    if (top == 0) return;
    const int bits = std::bit_width(static_cast<Word>(top));
    for (int v = 0; v < n_; ++v)
        key_[v] = static_cast<Word>(graph.vertex_colour[v]) << (64 - bits) | key_[v] >> bits;
}

void Partition::begin(const ColouredGraph& graph) {
    hash_surroundings(graph);
    if (n_ <= short_length) {  // the first place of a cell is the number of smaller keys: no branch to be guessed wrong
        const Word* keys = key_.data();
        const int n = n_;
        for (int v = 0; v < n; ++v) {
            const Word key = keys[v];
            Word smaller = 0;  // as wide as a key, so that several are compared at once
            for (int u = 0; u < n; ++u) smaller += keys[u] < key;
            cell_of[v] = static_cast<int>(smaller);
        }
    } else {
        for (int v = 0; v < n_; ++v) keyed_[v] = {key_[v], v};
        sort(keyed_.data(), keyed_.data() + n_);
        for (int i = 0, first = 0; i < n_; ++i) {
            if (keyed_[i].key != keyed_[first].key) first = i;
            cell_of[keyed_[i].vertex] = first;
        }
    }
    for (int i = 0; i < n_; ++i) size_of[i] = hits_[i] = waits_[i] = 0;
    for (int v = 0; v < n_; ++v) {
        const int place = cell_of[v] + size_of[cell_of[v]]++;
        vertex_at[place] = v;
        place_of[v] = place;
    }
    int largest = 0;
    cells = 0;
    for (int cell = 0; cell < n_; cell += size_of[cell]) {
        ++cells;
        if (size_of[cell] > size_of[largest]) largest = cell;
    }
    trail.clear();
    waiting_.clear();
    if (is_discrete()) return;
    for (int cell = 0; cell < n_; cell += size_of[cell])
        if (cell != largest) wait(cell);
}

void Partition::wait(int cell) {
    waiting_.push_back(cell);
    waits_[cell] = 1;
}

void Partition::single_out(int v) {
    const int cell = cell_of[v], place = place_of[v], last = cell + size_of[cell] - 1, u = vertex_at[last];
    vertex_at[place] = u;
    place_of[u] = place;
    vertex_at[last] = v;
    place_of[v] = last;
    --size_of[cell];
    size_of[last] = 1;
    cell_of[v] = last;
    hits_[last] = 0;
    trail.push_back({last, cell});
    ++cells;
    wait(last);
}

void Partition::undo(std::size_t mark) {
    for (; trail.size() > mark; trail.pop_back(), --cells) {
        const auto [born, parent] = trail.back();
        for (int i = born; i < born + size_of[born]; ++i) cell_of[vertex_at[i]] = parent;
        size_of[parent] += size_of[born];
    }
}

// Adds up, for every vertex of a cell of two or more, the weights of its edges into the splitting cell; vertices that are
// met move to the end of their cell. Returns a hash of the cells of single vertices that are met.
Word Partition::meet(const ColouredGraph& graph, int splitter) {
    const int count = size_of[splitter];
    for (int i = 0; i < count; ++i) splitter_[i] = vertex_at[splitter + i];
    Word single = static_cast<Word>(splitter) + 1;
    touched_.clear();
    for (int i = 0; i < count; ++i) {
        const int v = splitter_[i];
        for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
            const int w = graph.neighbour[e], cell = cell_of[w], size = size_of[cell];
            if (size == 1) {
                single += fold(static_cast<Word>(cell) * mixer) * weight_[e];
                continue;
            }
            if (hits_[cell] == 0) touched_.push_back(cell);
            const int place = place_of[w], last = cell + size - 1 - hits_[cell];
            if (place > last) {
                sum_[w] += weight_[e];
                continue;
            }
            const int u = vertex_at[last];
            vertex_at[place] = u;
            place_of[u] = place;
            vertex_at[last] = w;
            place_of[w] = last;
            ++hits_[cell];
            sum_[w] = weight_[e];
        }
    }
    return single;
}

// Cuts a cell of which vertices were met by their sums, and lets parts wait; returns the trace with what was done.
Word Partition::split(int cell, Word trace) {
    const int hits = hits_[cell], end = cell + size_of[cell], low = end - hits;
    hits_[cell] = 0;
    Word least = sum_[vertex_at[low]];
    bool even = true;
    for (int j = low + 1; j < end && even; ++j) even = sum_[vertex_at[j]] == least;
    if (!even) {
        for (int j = low; j < end; ++j) keyed_[j] = {sum_[vertex_at[j]], vertex_at[j]};
        sort(keyed_.data() + low, keyed_.data() + end);
        for (int j = low; j < end; ++j) {
            vertex_at[j] = keyed_[j].vertex;
            place_of[keyed_[j].vertex] = j;
        }
        least = keyed_[low].key;
    }
    trace = (trace ^ (static_cast<Word>(cell) + (static_cast<Word>(hits) << 32))) * golden;
    trace = fold((trace ^ least) * mixer);
    if (even && low == cell) return trace;
    const std::size_t mark = trail.size();
    int first = cell;
    if (low > cell) size_of[cell] = low - cell;
    for (int j = low; j < end; ++j) {
        const bool differs = j > low && !even && keyed_[j].key != keyed_[j - 1].key;
        if (differs) {
            size_of[first] = j - first;
            trace = fold((trace ^ keyed_[j].key) * second_mixer + static_cast<Word>(j));
        }
        if (differs || (j == low && low > cell)) {
            first = j;
            hits_[j] = 0;
            waits_[j] = 0;
            trail.push_back({j, cell});
            ++cells;
        }
        cell_of[vertex_at[j]] = first;
    }
    size_of[first] = end - first;
    let_parts_wait(cell, mark);
    return trace;
}

void Partition::let_parts_wait(int cell, std::size_t mark) {
    int left_out = -1;
    if (!waits_[cell]) {
        left_out = cell;
        for (std::size_t t = mark; t < trail.size(); ++t)
            if (size_of[trail[t].born] > size_of[left_out]) left_out = trail[t].born;
        if (left_out != cell) wait(cell);
    }
    for (std::size_t t = mark; t < trail.size(); ++t)
        if (trail[t].born != left_out) wait(trail[t].born);
}

Trace Partition::refine(const ColouredGraph& graph, const Bound& bound) {
    Trace result;
    Word trace = static_cast<Word>(cells) * golden;
    bool given_up = false;
    for (int step = 1; !waiting_.empty() && !is_discrete(); ++step) {
        if (step == early_steps) {
            result.early = trace;
            given_up = bound.excludes(trace);
            if (given_up) break;
        }
        const int splitter = waiting_.back();
        waiting_.pop_back();
        waits_[splitter] = 0;
        trace = fold((trace ^ meet(graph, splitter)) * second_mixer);
        // in the order of their places, not in the order they were met
        sort(touched_.data(), touched_.data() + touched_.size());
        for (const int cell : touched_) trace = split(cell, trace);
    }
    for (const int cell : waiting_) waits_[cell] = 0;
    waiting_.clear();
    if (given_up) return result;
    result.whole = mix(trace ^ static_cast<Word>(cells)) & ~Word{1};
    if (is_discrete()) result.whole |= 1;
    return result;
}

}  // namespace gruebler::labelling
