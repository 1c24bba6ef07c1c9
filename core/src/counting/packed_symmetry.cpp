#include "counting/packed_symmetry.hpp"

#include <memory>

#include "counting/reading.hpp"
#include "counting/symmetry.hpp"

namespace gruebler::counting {

GraphSymmetry find_symmetry(const std::uint64_t* words, int width) {
    const PackedGraph graph(words, width);
    const int n = graph.order();
    if (n < 1 || !is_consistent(n, graph)) return {SymmetryEnd::no_graph, 0, {}, {}};
    Neighbours around;
    around.survey(n, graph);
    const std::unique_ptr<Symmetry> symmetry(new Symmetry);
    const int group = symmetry->find(n, around.near, graph);
    if (group == 0) return {SymmetryEnd::too_many_automorphisms, n, {}, {}};
    GraphSymmetry found{SymmetryEnd::done, n, {}, {}};
    const Words& rows = symmetry->canonical.rows;
    found.rows.assign(rows.begin(), rows.end());
    found.images.reserve(static_cast<std::size_t>(group * n));
    for (int g = 0; g < group; ++g) {
        Vertices images{};
        symmetry->image(n, g, images);
        found.images.insert(found.images.end(), images.begin(), images.begin() + n);
    }
    return found;
}

}  // namespace gruebler::counting
