#include "counting/census.hpp"

#include <memory>

#include "counting/count.hpp"
#include "counting/reading.hpp"
#include "counting/symmetry.hpp"

namespace gruebler::counting::inline GRUEBLER_LEVEL {
namespace {

static_assert(most_mobility == most_freedoms);

constexpr int digits = 5;           // bits of each number in CensusRow::degrees
constexpr double largest = 9.2e18;  // of a number of 63 bits, rounding left over

// 2 MB, made once in some milliseconds.
const BlockTables& block_tables() {
    static const BlockTables tables;
    return tables;
}

// The memory of one call: five megabytes, of which little is touched.
class Census {
public:
    Census(int loops, int mobility, bool orbits) : loops_(loops), mobility_(mobility), orbits_(orbits) {
        const int most_strings = loops + 1;
        values_.fill(most_strings, mobility, 2);
        pair_values_.fill(most_strings, mobility, mobility == 0 ? 3 : 2);
    }

    CensusEnd count(const std::uint64_t* words, int width, CensusRow& row, Watch& watch) {
        if (!read_graph(words, width, loops_, graph_)) return CensusEnd::no_contracted_graph;
        if (!frame_.survey(graph_)) return CensusEnd::too_many_sets;
        const int n = frame_.nodes, group = symmetry_.find(n, frame_.around.near, graph_);
        if (group == 0) return CensusEnd::too_many_automorphisms;
        const Problem problem{mobility_, orbits_, n == 2 ? pair_values_ : values_};
        Totals totals;
        Count links = 0;  // of more than two joints: nodes
        for (int g = 0; g < group; ++g) {
            Vertices image{};
            const int fixed = symmetry_.image(n, g, image);
            const Count before = totals.found;
            if (!counter_.count(problem, image, frame_, tables_, totals, watch)) return CensusEnd::interrupted;
            links += static_cast<Count>(fixed) * (totals.found - before);
        }
        totals.links += links;
        return write(totals, static_cast<Count>(group), row);
    }

private:
    int loops_, mobility_;
    bool orbits_;
    Values values_, pair_values_;  // for two nodes alone F = 0 allows c = 3
    const BlockTables& tables_ = block_tables();
    PackedGraph graph_;
    Frame frame_;
    Symmetry symmetry_;
    Counter counter_;

    CensusEnd write(const Totals& totals, Count group, CensusRow& row) const {
        std::int64_t degrees = 0;
        for (int v = 0; v < frame_.nodes; ++v)
            degrees += std::int64_t{1} << (digits * (frame_.around.degree[v] - 3));
        const int joints = 3 * (loops_ - 1) + 1 + mobility_;
        if (totals.bulk * 2 * joints > largest) return CensusEnd::beyond_64_bits;
        if (totals.found % group != 0) return CensusEnd::no_whole_number;
        const auto mean = [group](Count sum) { return static_cast<std::int64_t>(sum / group); };
        row = {degrees, mean(totals.found), 0, 0, 0};
        if (!orbits_) return CensusEnd::done;
        if (totals.links % group != 0 || totals.joints % group != 0 || totals.flags % group != 0)
            return CensusEnd::no_whole_number;
        row.inversions = mean(totals.links);
        row.joint_orbits = mean(totals.joints);
        row.drives = mean(totals.flags);
        return CensusEnd::done;
    }
};

}  // namespace

CensusOutcome take_census(const GraphRows& graphs, int loops, int mobility, bool orbits, CensusRow* table,
                          Watch& watch) {
    const std::unique_ptr<Census> census(new Census(loops, mobility, orbits));
    for (std::int64_t k = 0; k < graphs.count; ++k) {
        const CensusEnd end = census->count(graphs.words + k * graphs.width, graphs.width, table[k], watch);
        if (end != CensusEnd::done) return {end, k};
    }
    return {CensusEnd::done, graphs.count};
}

}  // namespace gruebler::counting
