#include "atlas/circuits.hpp"

#include <algorithm>

namespace gruebler::atlas {
namespace {

using namespace bits;

constexpr int far = 1 << 20;       // longer than any string
constexpr int most_bundles = 62;   // bits of a word

}  // namespace

void Circuits::Strings::add(int length) {
    ++number;
    second_shortest = std::min(second_shortest, std::max(shortest, length));
    shortest = std::min(shortest, length);
    second_longest = std::max(second_longest, std::min(longest, length));
    longest = std::max(longest, length);
}

CircuitEnd Circuits::measure(const Chain& chain, Watch& watch) {
    smallest = far;
    largest = 0;
    find_strings(chain);
    if (nodes_ == 0) {
        smallest = largest = chain.links;
        return CircuitEnd::done;
    }
    if (!is_listed()) {
        const CircuitEnd end = list(watch);
        if (end != CircuitEnd::done) {
            listed_nodes_ = 0;
            return end;
        }
    }
    // A circuit is summed up over its bundles: each with both its ends, halved in the end.
    std::array<int, most_bundles> low{}, high{};
    for (int u = 0; u < nodes_; ++u) {
        for (int v = 0; v < u; ++v) {
            const Strings& strings = strings_[u][v];
            if (strings.number == 0) continue;
            const int ends = weight_[u] + weight_[v];
            low[place_[u][v]] = 2 * strings.shortest + ends;
            high[place_[u][v]] = 2 * strings.longest + ends;
            if (strings.number == 1) continue;
            smallest = std::min(smallest, strings.shortest + strings.second_shortest + ends);
            largest = std::max(largest, strings.longest + strings.second_longest + ends);
        }
    }
    for (const Word circuit : circuits_) {
        int least = 0, most = 0;
        for (Word set = circuit; set != 0; set = without_lowest(set)) {
            least += low[lowest(set)];
            most += high[lowest(set)];
        }
        smallest = std::min(smallest, least / 2);
        largest = std::max(largest, most / 2);
    }
    return CircuitEnd::done;
}

// A string from a node back to it is a circuit of its own.
void Circuits::find_strings(const Chain& chain) {
    const labelling::ColouredGraph& graph = chain.labeller.graph();
    nodes_ = 0;
    for (int v = 0; v < chain.vertices(); ++v) {
        node_of_[v] = -1;
        if (graph.degree(v) < 3) continue;
        weight_[nodes_] = v < chain.links;
        node_of_[v] = nodes_++;
    }
    for (int u = 0; u < nodes_; ++u)
        for (int v = 0; v < nodes_; ++v) strings_[u][v] = {0, far, far, -far, -far};
    for (int v = 0; v < chain.vertices(); ++v) {
        if (node_of_[v] < 0) continue;
        for (int e = graph.start[v]; e < graph.start[v + 1]; ++e) {
            int last = v, here = graph.neighbour[e], length = 0;
            while (node_of_[here] < 0) {
                ++length;
                const int* around = graph.neighbour.data() + graph.start[here];
                const int step = around[0] != last ? around[0] : around[1];
                last = here;
                here = step;
            }
            if (here != v) {
                strings_[node_of_[v]][node_of_[here]].add(length);
                continue;
            }
            length += weight_[node_of_[v]];
            smallest = std::min(smallest, length);
            largest = std::max(largest, length);
        }
    }
}

// Whether the same nodes were joined in the chain before; else notes which are now.
bool Circuits::is_listed() {
    bool same = listed_nodes_ == nodes_;
    for (int u = 0; u < nodes_; ++u) {
        for (int v = 0; v < nodes_; ++v) {
            const bool joined = strings_[u][v].number > 0;
            same = same && joined_[u][v] == joined;
            joined_[u][v] = joined;
        }
    }
    return same;
}

CircuitEnd Circuits::list(Watch& watch) {
    int bundles = 0;
    for (int u = 0; u < nodes_; ++u)
        for (int v = 0; v < u; ++v)
            if (joined_[u][v]) place_[u][v] = place_[v][u] = bundles++;
    if (bundles > most_bundles) return CircuitEnd::too_many;
    listed_nodes_ = nodes_;
    circuits_.clear();
    std::array<Path, most_vertices> paths;
    for (int start = 0; start < nodes_; ++start) {  // the least node of the circuit
        int depth = 0;
        paths[0] = {start, start + 1, 0, bit(start)};
        while (depth >= 0) {
            Path& path = paths[depth];
            const int u = path.node, v = path.next++;
            if (v >= nodes_) {
                --depth;
                continue;
            }
            if (!joined_[u][v] || has(path.nodes, v)) continue;
            if (!spend(watch, 1)) return CircuitEnd::interrupted;
            const Word through = path.bundles | bit(place_[u][v]);
            paths[depth + 1] = {v, start + 1, through, path.nodes | bit(v)};
            ++depth;
            if (depth < 2 || paths[1].node > v || !joined_[v][start]) continue;
            if (circuits_.size() == most_circuits) return CircuitEnd::too_many;
            circuits_.push_back(through | bit(place_[v][start]));
        }
    }
    return CircuitEnd::done;
}

}  // namespace gruebler::atlas
