// Automorphisms read off two nodes of the search tree, their orbits, and the comparison of leaves.
//
// Everything here compares edges and colours themselves, never hashes of them: it is where the labelling gets its
// exactness from (docs/theory/canonical-code.md).
#pragma once

#include <vector>

#include "labelling/partition.hpp"

namespace gruebler::labelling {

// Disjoint sets of vertices, each with its least vertex as its root.
class Orbits {
public:
    explicit Orbits(int n) : parent_(n) {}

    void clear() {
        for (std::size_t v = 0; v < parent_.size(); ++v) parent_[v] = static_cast<int>(v);
    }

    void isolate(int v) { parent_[v] = v; }
    bool is_root(int v) const { return parent_[v] == v; }

    int root(int v) {  // and the way to it is shortened
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }

    // Whether they were two.
    bool join(int v, int w) {
        v = root(v);
        w = root(w);
        parent_[std::max(v, w)] = std::min(v, w);
        return v != w;
    }

private:
    std::vector<int> parent_;
};

// A vertex moved by an automorphism.
struct Move {
    int from, to;
};

// The edges of a leaf: for each place the sorted pairs (later place, colour) of its edges.
class Form {
public:
    Form(int n, const std::vector<int>& vertex_at) : vertex_at_(vertex_at), place_of_(n) {}

    // Writes the form of the leaf down when it is next needed.
    void change() { ready_ = false; }

    // Whether the form of a discrete partition comes before this one.
    bool follows(const ColouredGraph& graph, const Partition& leaf);

private:
    const std::vector<int>& vertex_at_;  // of the leaf
    bool ready_ = false;
    std::vector<int> place_of_;
    std::vector<std::vector<Word>> rows_;
    std::vector<Word> row_;

    void write(const ColouredGraph& graph);
};

class Automorphisms {
public:
    explicit Automorphisms(int n);

    Orbits orbits;
    std::vector<std::vector<Move>> generators;

    void clear();

    // Tries to read an automorphism off a known leaf and the present node; keeps it if it is one.
    //
    // Vertices that became single since `mark` are paired with those of the leaf at the same places, chains of pairs are
    // closed to cycles, and all else stays fixed. At a leaf this is the only map that respects the places; above, it is a
    // guess, right whenever the cells that are left have nothing to do with the difference of the two nodes.
    // Cost: O(d log d) for the d edges around the vertices moved.
    bool find(const ColouredGraph& graph, const std::vector<int>& leaf, const Partition& node, std::size_t mark);

private:
    // The map under trial: the identity between trials.
    std::vector<int> image_, inverse_, moved_;
    std::vector<Word> near_, far_;

    void pair_up(const std::vector<int>& leaf, const Partition& node, std::size_t mark);
    void close_chains();
    bool respects(const ColouredGraph& graph);
    void keep();
};

}  // namespace gruebler::labelling
