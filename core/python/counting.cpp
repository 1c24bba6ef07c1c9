#include <iterator>

#include "base/processor.hpp"
#include "counting/census.hpp"
#include "counting/graph6.hpp"
#include "counting/growth.hpp"
#include "counting/listing.hpp"
#include "counting/packed_symmetry.hpp"
#include "doors.hpp"

namespace gruebler::doors {
namespace {

using namespace counting;

struct LevelOfCensus {
    Level level;
    const char* name;
    TakeCensus* take;
};

// The least level first.
constexpr LevelOfCensus levels[] = {
    {Level::baseline, "baseline", counting::baseline::take_census},
#ifdef GRUEBLER_X86_LEVELS
    {Level::v3, "v3", counting::v3::take_census},
    {Level::v4, "v4", counting::v4::take_census},
#endif
};

// The best level of this processor, or the one that is named.
TakeCensus* census_of(const std::string& name) {
    const Level highest = highest_level();
    TakeCensus* best = nullptr;
    for (const LevelOfCensus& each : levels) {
        if (each.level > highest) break;
        if (name.empty() || name == each.name) best = each.take;
    }
    expect(best != nullptr, "this processor has no level " + name);
    return best;
}

nb::list level_names() {
    nb::list names;
    const Level highest = highest_level();
    for (const LevelOfCensus& each : levels)
        if (each.level <= highest) names.append(each.name);
    return names;
}

GraphRows rows_of(const Array<std::int64_t, -1, -1>& graphs) {
    expect(graphs.shape(1) >= 2 && graphs.shape(1) <= most_nodes, "a packed graph has 2 to 18 rows");
    return {reinterpret_cast<const std::uint64_t*>(graphs.data()), static_cast<std::int64_t>(graphs.shape(0)),
            static_cast<int>(graphs.shape(1))};
}

std::string graph_is(std::int64_t k, const char* what) { return "graph " + std::to_string(k) + " " + what; }

constexpr const char* no_contracted_graph =
    "is not a connected graph of this number of loops with two or more nodes, all of three or more strings";
constexpr const char* too_many_automorphisms = "has more automorphisms than there is room for";

constexpr const char* too_many_sets = "has more critical sets than there is room for";

void check_chains(int loops, int mobility) {
    expect(loops >= 2 && loops <= most_loops, "there are 2 to 10 loops");
    expect(mobility >= 0 && mobility <= most_mobility, "the mobility is 0 to 24");
}

NewArray<std::int64_t> take_census(const Array<std::int64_t, -1, -1>& graphs, int loops, int mobility, bool orbits,
                                   const std::string& level) {
    check_chains(loops, mobility);
    const GraphRows rows = rows_of(graphs);
    TakeCensus* take = census_of(level);
    std::vector<CensusRow> table(graphs.shape(0));
    const auto [end, k] = run([&](Watch& watch) { return take(rows, loops, mobility, orbits, table.data(), watch); });
    switch (end) {
        case CensusEnd::done:
        case CensusEnd::interrupted:
            break;
        case CensusEnd::no_contracted_graph:
            throw nb::value_error(graph_is(k, no_contracted_graph).c_str());
        case CensusEnd::too_many_sets:
            throw nb::value_error(graph_is(k, too_many_sets).c_str());
        case CensusEnd::too_many_automorphisms:
            throw nb::value_error(graph_is(k, too_many_automorphisms).c_str());
        case CensusEnd::beyond_64_bits:
            PyErr_SetString(PyExc_OverflowError, "the numbers of one contracted graph do not fit in 64 bits");
            throw nb::python_error();
        case CensusEnd::no_whole_number:
            throw nb::value_error("the sum over the automorphisms is not a multiple of their number");
    }
    const size_t count = table.size();
    return hand_over<std::int64_t>(std::move(table), {count, sizeof(CensusRow) / sizeof(std::int64_t)});
}

nb::tuple add_loop(const Array<std::int64_t, -1, -1>& parents, int loops, std::int64_t first, std::int64_t enough) {
    expect(loops >= 2 && loops < most_loops, "the parents have 2 to 9 loops");
    expect(first >= 0 && first <= static_cast<std::int64_t>(parents.shape(0)), "the first parent is one of the list");
    expect(enough >= 1, "at least one graph is to be enough");
    const GraphRows rows = rows_of(parents);
    std::vector<Words> children;
    const auto [end, next] =
        run([&](Watch& watch) { return counting::add_loop(rows, loops, first, enough, children, watch); });
    if (end == GrowthEnd::no_contracted_graph) throw nb::value_error(graph_is(next, no_contracted_graph).c_str());
    if (end == GrowthEnd::too_many_automorphisms)
        throw nb::value_error(graph_is(next, too_many_automorphisms).c_str());
    const size_t count = children.size();
    return nb::make_tuple(hand_over<std::int64_t>(std::move(children), {count, most_nodes}), next);
}

std::vector<std::uint8_t> listed(const Array<std::int64_t, -1, -1>& graphs, int loops, int mobility, Form form) {
    check_chains(loops, mobility);
    const GraphRows rows = rows_of(graphs);
    std::vector<std::uint8_t> bytes;
    const auto [end, k] =
        run([&](Watch& watch) { return counting::list_chains(rows, loops, mobility, form, bytes, watch); });
    switch (end) {
        case ListEnd::done:
        case ListEnd::interrupted:
            break;
        case ListEnd::no_contracted_graph:
            throw nb::value_error(graph_is(k, no_contracted_graph).c_str());
        case ListEnd::too_many_sets:
            throw nb::value_error(graph_is(k, too_many_sets).c_str());
        case ListEnd::too_many_automorphisms:
            throw nb::value_error(graph_is(k, too_many_automorphisms).c_str());
    }
    return bytes;
}

NewArray<std::uint8_t> list_chains(const Array<std::int64_t, -1, -1>& graphs, int loops, int mobility) {
    auto bytes = listed(graphs, loops, mobility, Form::edges);
    const auto joints = static_cast<size_t>(joints_of(loops, mobility));
    const size_t count = bytes.size() / (2 * joints);
    return hand_over<std::uint8_t>(std::move(bytes), {count, joints, 2});
}

NewArray<std::uint8_t> list_graph6(const Array<std::int64_t, -1, -1>& graphs, int loops, int mobility) {
    auto bytes = listed(graphs, loops, mobility, Form::lines);
    const auto length = static_cast<size_t>(graph6_length(links_of(loops, mobility)));
    const size_t count = bytes.size() / length;
    return hand_over<std::uint8_t>(std::move(bytes), {count, length});
}

NewArray<std::uint8_t> write_graph6(const Array<std::uint8_t, -1, -1, 2>& edges, int links) {
    expect(links >= 0 && links <= most_vertices, "there are 0 to 255 links");
    const size_t count = edges.shape(0), joints = edges.shape(1);
    const auto length = static_cast<size_t>(graph6_length(links));
    const std::uint8_t* ends = edges.data();
    for (size_t i = 0; i < count * joints; ++i)
        if (ends[2 * i] >= links || ends[2 * i + 1] >= links || ends[2 * i] == ends[2 * i + 1])
            throw nb::value_error(graph_is(static_cast<std::int64_t>(i / joints),
                                           "has an edge that does not join two of its links").c_str());
    std::vector<std::uint8_t> lines(count * length);
    run([&](Watch& watch) {
        for (size_t k = 0; k < count; ++k) {
            std::uint8_t* line = lines.data() + k * length;
            begin_graph6(links, line);
            for (const std::uint8_t* end = ends + 2 * k * joints; end < ends + 2 * (k + 1) * joints; end += 2)
                add_graph6_edge(end[0], end[1], graph6_head(links), line);
            if (!spend(watch, static_cast<std::int64_t>(length + joints))) return false;
        }
        return true;
    });
    return hand_over<std::uint8_t>(std::move(lines), {count, length});
}

GraphSymmetry symmetry_of(const Array<std::int64_t, -1>& rows) {
    expect(rows.shape(0) >= 1 && rows.shape(0) <= most_nodes, "a packed graph has 1 to 18 rows");
    GraphSymmetry found = find_symmetry(reinterpret_cast<const std::uint64_t*>(rows.data()),
                                        static_cast<int>(rows.shape(0)));
    expect(found.end != SymmetryEnd::no_graph, "the rows are not those of a packed graph without isolated vertices");
    expect(found.end != SymmetryEnd::too_many_automorphisms, std::string("the graph ") + too_many_automorphisms);
    return found;
}

NewArray<std::int64_t> canonical_rows(const Array<std::int64_t, -1>& rows) {
    return hand_over<std::int64_t>(symmetry_of(rows).rows, {most_nodes});
}

NewArray<std::int64_t> find_automorphisms(const Array<std::int64_t, -1>& rows) {
    GraphSymmetry found = symmetry_of(rows);
    const auto n = static_cast<size_t>(found.vertices), group = found.images.size() / n;
    return hand_over<std::int64_t>(std::move(found.images), {group, n});
}

}  // namespace

void add_counting(nb::module_& module) {
    module.def("level_names", level_names, "The levels that this processor has, the least first.");
    module.def("take_census", take_census, nb::arg("graphs").noconvert(), nb::arg("loops"), nb::arg("mobility"),
               nb::arg("orbits"), nb::kw_only(), nb::arg("level") = "",
               "Counts the chains of each contracted graph: int64[k, 5], degrees, chains, and if orbits are asked for "
               "inversions, orbits of joints, drives.\n\n"
               "graphs: int64[k, nodes], packed graphs of so many loops. level: for tests, one of level_names().");
    module.def("add_loop", add_loop, nb::arg("parents").noconvert(), nb::arg("loops"), nb::arg("first"),
               nb::arg("enough"),
               "The contracted graphs with one loop more that have their canonical parent in a list: int64[m, 18] and "
               "the parent to go on with.\n\n"
               "parents: int64[k, nodes], packed graphs of so many loops, each isomorphism class once; begins with the "
               "parent `first` and ends after the one that brings `enough` graphs.");
    module.def("list_chains", list_chains, nb::arg("graphs").noconvert(), nb::arg("loops"), nb::arg("mobility"),
               "The chains of contracted graphs, each once: uint8[m, joints, 2], a joint by its two links.\n\n"
               "graphs: int64[k, nodes], packed canonical graphs of so many loops. The links of a chain are the nodes of "
               "its contracted graph and then the binary links, string by string in the order of bundles.");
    module.def("list_graph6", list_graph6, nb::arg("graphs").noconvert(), nb::arg("loops"), nb::arg("mobility"),
               "The chains of `list_chains` as lines of graph6, their ends included: uint8[m, bytes].");
    module.def("write_graph6", write_graph6, nb::arg("edges").noconvert(), nb::arg("links"),
               "Chains as lines of graph6, their ends included: uint8[k, bytes].\n\nedges: uint8[k, joints, 2].");
    module.def("canonical_rows", canonical_rows, nb::arg("rows").noconvert(),
               "The canonical rows of one packed graph: int64[18].");
    module.def("find_automorphisms", find_automorphisms, nb::arg("rows").noconvert(),
               "The automorphisms of one packed graph, as images of its vertices: int64[k, n], the identity first.");
}

}  // namespace gruebler::doors
