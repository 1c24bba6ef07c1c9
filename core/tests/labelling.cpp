// The labelling without Python, for sanitizers: orders of groups that the literature knows, and equal forms of graphs that
// are numbered anew.
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <utility>
#include <vector>

#include "check.hpp"
#include "labelling/labeller.hpp"

using namespace gruebler;
using namespace gruebler::labelling;

namespace {

using Edges = std::vector<std::pair<int, int>>;

struct Answer {
    Edges form;
    std::int64_t order;
};

Answer solve(int n, const Edges& edges) {
    const std::vector<std::int64_t> colours(n);
    std::vector<std::int32_t> ends;
    for (const auto& [u, v] : edges) ends.insert(ends.end(), {u, v});
    ColouredGraph graph(n, colours.data());
    graph.set_edges(static_cast<std::int64_t>(edges.size()), ends.data(), nullptr);
    Labeller labeller(n);
    Watch watch{always, nullptr};
    expect(labeller.label(graph, watch), "a labelling did not end");
    Answer answer{{}, 1};
    for (const std::int64_t factor : labeller.factors) answer.order *= factor;
    for (const auto& [u, v] : edges)
        answer.form.push_back(std::minmax({labeller.place_of[u], labeller.place_of[v]}));
    std::sort(answer.form.begin(), answer.form.end());
    return answer;
}

// i -> factor * i + 1: another numbering if the factor is prime to n.
Edges numbered_anew(int n, const Edges& edges, int factor) {
    Edges other;
    for (const auto& [u, v] : edges) other.emplace_back((factor * u + 1) % n, (factor * v + 1) % n);
    std::reverse(other.begin(), other.end());
    return other;
}

void check(const char* name, int n, const Edges& edges, std::int64_t order) {
    const Answer answer = solve(n, edges);
    expect(answer.order == order, name);
    for (int factor = 2; factor < n; ++factor)
        if (std::gcd(factor, n) == 1) expect(solve(n, numbered_anew(n, edges, factor)).form == answer.form, name);
    std::printf("%s\n", name);
}

Edges circulant(int n, const std::vector<int>& jumps) {
    Edges edges;
    for (int v = 0; v < n; ++v)
        for (const int jump : jumps) edges.emplace_back(v, (v + jump) % n);
    return edges;
}

// Two rings of n spokes, the inner one stepping by k.
Edges petersen(int n, int k) {
    Edges edges;
    for (int v = 0; v < n; ++v) {
        edges.emplace_back(v, (v + 1) % n);
        edges.emplace_back(v, n + v);
        edges.emplace_back(n + v, n + (v + k) % n);
    }
    return edges;
}

Edges hypercube(int dimension) {
    Edges edges;
    for (int v = 0; v < 1 << dimension; ++v)
        for (int b = 0; b < dimension; ++b)
            if ((v >> b & 1) == 0) edges.emplace_back(v, v | 1 << b);
    return edges;
}

}  // namespace

int main() {
    check("no vertex", 0, {}, 1);
    check("one vertex", 1, {}, 1);
    check("ten vertices", 10, {}, 3628800);
    check("a ring of 30", 30, circulant(30, {1}), 60);
    check("the Petersen graph", 10, petersen(5, 2), 120);
    check("the Desargues graph", 20, petersen(10, 3), 240);
    check("the Nauru graph", 24, petersen(12, 5), 144);
    check("the hypercube of 5 dimensions", 32, hypercube(5), 3840);
    check("the Moebius-Kantor graph", 16, petersen(8, 3), 96);
    check("parallel edges", 3, {{0, 1}, {0, 1}, {1, 2}}, 1);
}
