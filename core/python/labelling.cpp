#include <limits>

#include "doors.hpp"
#include "labelling/labeller.hpp"

namespace gruebler::doors {
namespace {

using namespace labelling;

using Edges = Array<std::int32_t, -1, 2>;

constexpr std::int64_t most_ends = std::numeric_limits<std::int32_t>::max() - 1;  // they are numbered by int

void check_edges(int n, const Edges& edges) {
    expect(n >= 0, "the number of vertices is not negative");
    const auto ends = static_cast<std::int64_t>(edges.size());
    expect(ends <= most_ends, "there are too many edges");
    const std::int32_t* end = edges.data();
    for (std::int64_t i = 0; i < ends; i += 2) {
        const bool known = end[i] >= 0 && end[i] < n && end[i + 1] >= 0 && end[i + 1] < n;
        if (!known) throw nb::value_error(("edge " + std::to_string(i / 2) + " ends at a vertex beyond 0.." +
                                           std::to_string(n - 1)).c_str());
        if (end[i] == end[i + 1]) throw nb::value_error(("edge " + std::to_string(i / 2) + " is a loop").c_str());
    }
}

template <class Number>
void check_colours(const Array<Number, -1>& colours, std::size_t length, const char* name) {
    expect(colours.shape(0) == length, std::string(name) + " must have the shape (" + std::to_string(length) + ",)");
    for (std::size_t i = 0; i < length; ++i)
        expect(colours.data()[i] >= 0 && colours.data()[i] <= std::numeric_limits<std::int32_t>::max(),
               std::string(name) + " must lie in 0..2147483647");
}

// One automorphism a row, as images of the vertices.
std::vector<std::int32_t> written_out(int n, const std::vector<std::vector<Move>>& generators) {
    std::vector<std::int32_t> images(generators.size() * static_cast<std::size_t>(n));
    for (std::size_t g = 0; g < generators.size(); ++g) {
        std::int32_t* image = images.data() + g * static_cast<std::size_t>(n);
        for (int v = 0; v < n; ++v) image[v] = v;
        for (const Move& move : generators[g]) image[move.from] = move.to;
    }
    return images;
}

nb::tuple canonical_form(int n, const Array<std::int64_t, -1>& vertex_colour, const Edges& edges,
                         const Array<std::int32_t, -1>& edge_colour) {
    check_edges(n, edges);
    check_colours(vertex_colour, static_cast<std::size_t>(n), "vertex_colour");
    check_colours(edge_colour, edges.shape(0), "edge_colour");
    Labeller labeller(n);
    ColouredGraph graph(n, vertex_colour.data());
    run([&](Watch& watch) {
        graph.set_edges(static_cast<std::int64_t>(edges.shape(0)), edges.data(), edge_colour.data());
        return labeller.label(graph, watch);
    });
    const auto vertices = static_cast<std::size_t>(n), count = labeller.generators().size();
    auto generators = written_out(n, labeller.generators());
    const std::size_t factors = labeller.factors.size();
    return nb::make_tuple(hand_over<std::int32_t>(std::move(labeller.place_of), {vertices}),
                          hand_over<std::int32_t>(std::move(generators), {count, vertices}),
                          hand_over<std::int32_t>(std::move(labeller.orbit_of), {vertices}),
                          hand_over<std::int64_t>(std::move(labeller.factors), {factors}));
}

NewArray<std::int32_t> canonical_bulk(int n, const Edges& edges, const Array<std::int64_t, -1>& bounds) {
    check_edges(n, edges);
    const std::size_t length = bounds.shape(0);
    const std::int64_t* bound = bounds.data();
    bool ascends = length > 0 && bound[0] == 0 && bound[length - 1] == static_cast<std::int64_t>(edges.shape(0));
    for (std::size_t i = 1; i < length; ++i) ascends = ascends && bound[i - 1] <= bound[i];
    expect(ascends, "bounds must ascend from 0 to the number of edges " + std::to_string(edges.shape(0)));
    const std::size_t graphs = length - 1, vertices = static_cast<std::size_t>(n);
    std::vector<std::int32_t> labellings(graphs * vertices);
    const std::vector<std::int64_t> one_colour(vertices);
    Labeller labeller(n);
    ColouredGraph graph(n, one_colour.data());
    run([&](Watch& watch) {
        for (std::size_t i = 0; i < graphs; ++i) {
            graph.set_edges(bound[i + 1] - bound[i], edges.data() + 2 * bound[i], nullptr);
            if (!labeller.label(graph, watch)) return false;
            for (std::size_t v = 0; v < vertices; ++v) labellings[i * vertices + v] = labeller.place_of[v];
        }
        return true;
    });
    return hand_over<std::int32_t>(std::move(labellings), {graphs, vertices});
}

}  // namespace

void add_labelling(nb::module_& module) {
    module.def("canonical_form", canonical_form, nb::arg("n"), nb::arg("vertex_colour").noconvert(),
               nb::arg("edges").noconvert(), nb::arg("edge_colour").noconvert(),
               "The canonical labelling and the automorphism group of a coloured multigraph: places int32[n], generators "
               "int32[k, n], orbits int32[n], and the factors of the order of the group, int64.\n\n"
               "vertex_colour: int64[n], edges: int32[m, 2], edge_colour: int32[m].");
    module.def("canonical_bulk", canonical_bulk, nb::arg("n"), nb::arg("edges").noconvert(),
               nb::arg("bounds").noconvert(),
               "The canonical labellings of many graphs of n vertices, of one vertex and one edge colour: "
               "int32[graphs, n].\n\n"
               "edges: int32[total, 2]; bounds: int64[graphs + 1], graph i has edges[bounds[i]:bounds[i + 1]].");
}

}  // namespace gruebler::doors
