// The counting kernels without Python, for sanitizers: chains with F = 1 of 6 to 14 links against OEIS A233288, and with
// F = 0, 2, 3 that nothing is read or written beyond an array.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "check.hpp"
#include "counting/census.hpp"
#include "counting/graph6.hpp"
#include "counting/growth.hpp"
#include "counting/listing.hpp"
#include "counting/packed_symmetry.hpp"

using namespace gruebler;
using namespace gruebler::counting;

namespace {

constexpr std::int64_t chains_of_loops[] = {0, 0, 2, 16, 230, 6856, 318162};  // OEIS A233288: 2 loops, 6 links, 2 chains

GraphRows rows_of(const std::vector<Words>& graphs) {
    return {graphs.data()->data(), static_cast<std::int64_t>(graphs.size()), most_nodes};
}

}  // namespace

int main(int argc, char** argv) {
    const int most = argc > 1 ? std::atoi(argv[1]) : 6;
    Watch watch{always, nullptr};
    std::vector<Words> graphs(1);
    graphs[0][0] = 3 << 4, graphs[0][1] = 3;
    for (int loops = 2; loops <= most; ++loops) {
        if (loops > 2) {
            std::vector<Words> children;
            const GrowthOutcome grown = add_loop(rows_of(graphs), loops - 1, 0, INT64_MAX, children, watch);
            expect(grown.end == GrowthEnd::done, "a loop was not added");
            graphs = std::move(children);
        }
        std::vector<CensusRow> table(graphs.size());
        for (int mobility = 0; mobility <= 3; ++mobility) {
            const auto outcome = take_census(rows_of(graphs), loops, mobility, true, table.data(), watch);
            expect(outcome.end == CensusEnd::done, "a census did not end");
            if (mobility != 1) continue;
            std::int64_t chains = 0;
            for (const CensusRow& row : table) chains += row.chains;
            expect(chains == chains_of_loops[loops], "another number of chains than OEIS");
            for (const Form form : {Form::edges, Form::lines}) {
                std::vector<std::uint8_t> bytes;
                expect(list_chains(rows_of(graphs), loops, mobility, form, bytes, watch).end == ListEnd::done,
                       "a list did not end");
                const int links = links_of(loops, mobility), row = form == Form::edges ? 2 * joints_of(loops, mobility)
                                                                                      : graph6_length(links);
                expect(static_cast<std::int64_t>(bytes.size()) == chains * row, "another number of chains in a list");
            }
        }
        for (const Words& graph : graphs)
            expect(find_symmetry(graph.data(), most_nodes).end == SymmetryEnd::done, "no symmetry was found");
        Watch impatient{never, nullptr, 1};
        expect(take_census(rows_of(graphs), loops, 1, true, table.data(), impatient).end == CensusEnd::interrupted,
               "a census went on after it was to end");
        std::printf("%d loops: %zu graphs\n", loops, graphs.size());
    }
    graphs[0][0] = ~std::uint64_t{0};
    std::vector<Words> children;
    expect(add_loop(rows_of(graphs), 3, 0, 1, children, watch).end == GrowthEnd::no_contracted_graph,
           "something else was taken for a contracted graph");
}
