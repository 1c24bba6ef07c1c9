#include "labelling/automorphisms.hpp"

#include <numeric>

namespace gruebler::labelling {
namespace {

// The sorted pairs (name, colour) of the edges at v to names > `above`.
template <class Name>
void write_row(const ColouredGraph& graph, int v, int above, Name name_of, std::vector<Word>& row) {
    row.clear();
    for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
        const int name = name_of(graph.neighbour[e]);
        if (name > above) row.push_back(static_cast<Word>(name) << 32 | static_cast<Word>(graph.edge_colour[e]));
    }
    sort(row.data(), row.data() + row.size());
}

}  // namespace

void Form::write(const ColouredGraph& graph) {
    rows_.resize(graph.n);
    for (int i = 0; i < graph.n; ++i) place_of_[vertex_at_[i]] = i;
    for (int i = 0; i < graph.n; ++i)
        write_row(graph, vertex_at_[i], i, [this](int u) { return place_of_[u]; }, rows_[i]);
    ready_ = true;
}

bool Form::follows(const ColouredGraph& graph, const Partition& leaf) {
    if (!ready_) write(graph);
    for (int i = 0; i < graph.n; ++i) {
        write_row(graph, leaf.vertex_at[i], i, [&leaf](int u) { return leaf.place_of[u]; }, row_);
        if (row_.size() != rows_[i].size()) return row_.size() < rows_[i].size();
        if (row_ != rows_[i]) return row_ < rows_[i];
    }
    return false;
}

Automorphisms::Automorphisms(int n) : orbits(n), image_(n), inverse_(n) {
    std::iota(image_.begin(), image_.end(), 0);
    std::iota(inverse_.begin(), inverse_.end(), 0);
    moved_.reserve(n);
}

void Automorphisms::clear() {
    orbits.clear();
    generators.clear();
}

bool Automorphisms::find(const ColouredGraph& graph, const std::vector<int>& leaf, const Partition& node,
                         std::size_t mark) {
    pair_up(leaf, node, mark);
    close_chains();
    const bool respected = !moved_.empty() && respects(graph);
    if (respected) keep();
    for (const int v : moved_) image_[v] = inverse_[v] = v;
    moved_.clear();
    return respected;
}

void Automorphisms::pair_up(const std::vector<int>& leaf, const Partition& node, std::size_t mark) {
    for (std::size_t t = mark; t < node.trail.size(); ++t) {
        for (const int place : {node.trail[t].born, node.trail[t].parent}) {
            if (node.size_of[place] != 1) continue;
            const int v = leaf[place], w = node.vertex_at[place];
            if (v == w || image_[v] != v) continue;
            image_[v] = w;
            inverse_[w] = v;
            moved_.push_back(v);
        }
    }
}

// The end of a chain goes to its beginning.
void Automorphisms::close_chains() {
    const std::size_t paired = moved_.size();
    for (std::size_t i = 0; i < paired; ++i) {
        const int first = moved_[i];
        if (inverse_[first] != first) continue;
        int last = image_[first];
        while (image_[last] != last) last = image_[last];
        image_[last] = first;
        inverse_[first] = last;
        moved_.push_back(last);
    }
}

// Whether the map under trial respects vertex colours and the edges around all vertices it moves.
bool Automorphisms::respects(const ColouredGraph& graph) {
    for (const int v : moved_) {
        const int w = image_[v];
        if (graph.vertex_colour[v] != graph.vertex_colour[w] || graph.degree(v) != graph.degree(w)) return false;
    }
    for (const int v : moved_) {
        write_row(graph, v, -1, [this](int u) { return image_[u]; }, near_);
        write_row(graph, image_[v], -1, [](int u) { return u; }, far_);
        if (near_ != far_) return false;
    }
    return true;
}

// Unites orbits and, if that made fewer of them, stores the map: so there are fewer than n generators.
void Automorphisms::keep() {
    bool useful = false;
    for (const int v : moved_) useful |= orbits.join(v, image_[v]);
    if (!useful) return;
    std::vector<Move>& generator = generators.emplace_back();
    generator.reserve(moved_.size());
    for (const int v : moved_) generator.push_back({v, image_[v]});
}

}  // namespace gruebler::labelling
