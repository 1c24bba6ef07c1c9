// Graphs written down edge by edge and labelled, one after another, of different numbers of vertices.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "labelling/labeller.hpp"

namespace gruebler::labelling {

// The memory for a number of vertices is made when such a graph comes first.
class GraphLabeller {
public:
    explicit GraphLabeller(int most_vertices)
        : colour_(static_cast<std::size_t>(most_vertices)), sized_(static_cast<std::size_t>(most_vertices) + 1) {}

    // A graph without edges, all vertices of one colour.
    void begin(int vertices, std::int64_t colour) {
        n_ = vertices;
        for (int v = 0; v < n_; ++v) colour_[v] = colour;
        ends_.clear();
        edge_colour_.clear();
    }

    void colour(int v, std::int64_t colour) { colour_[v] = colour; }

    void join(int u, int v, int colour) {
        ends_.push_back(u);
        ends_.push_back(v);
        edge_colour_.push_back(colour);
    }

    // False if the watch ends the work.
    bool label(Watch& watch) {
        if (!sized_[n_]) sized_[n_].reset(new Sized{Labeller(n_), ColouredGraph(n_, colour_.data())});
        Sized& sized = *sized_[n_];
        sized.graph.set_edges(static_cast<std::int64_t>(edge_colour_.size()), ends_.data(), edge_colour_.data());
        return sized.labeller.label(sized.graph, watch);
    }

    // The answer, and the graph as rows of neighbours; good until the next graph is labelled.
    const Labeller& answer() const { return sized_[n_]->labeller; }
    const ColouredGraph& graph() const { return sized_[n_]->graph; }
    int place(int v) const { return answer().place_of[v]; }
    const std::vector<std::vector<Move>>& generators() const { return answer().generators(); }

    // Where a generator takes each vertex.
    void write_image(const std::vector<Move>& generator, std::vector<int>& image) const {
        image.resize(colour_.size());
        for (int v = 0; v < n_; ++v) image[v] = v;
        for (const Move& move : generator) image[move.from] = move.to;
    }

private:
    struct Sized {
        Labeller labeller;
        ColouredGraph graph;
    };

    int n_ = 0;
    std::vector<std::int64_t> colour_;
    std::vector<std::int32_t> ends_, edge_colour_;
    std::vector<std::unique_ptr<Sized>> sized_;
};

}  // namespace gruebler::labelling
