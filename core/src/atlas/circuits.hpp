// The smallest and the largest circuit of a chain, from the circuits of its nodes and the strings between them.
#pragma once

#include <array>
#include <vector>

#include "atlas/chain.hpp"
#include "base/watch.hpp"

namespace gruebler::atlas {

inline constexpr int most_circuits = 4096;  // a chain of L loops has fewer than 2^L among its links of three joints and more

enum class CircuitEnd { done, interrupted, too_many };

// Nodes are the vertices of three edges or more; a string has the links between two nodes. Successive chains often have
// the same nodes and strings: their circuits are listed once.
class Circuits {
public:
    int smallest = 0, largest = 0;  // numbers of links

    // For a chain that has been labelled.
    CircuitEnd measure(const Chain& chain, Watch& watch);

private:
    // The strings between two nodes, by the number of their links.
    struct Strings {
        int number, shortest, second_shortest, longest, second_longest;

        void add(int length);
    };

    // A path that may become a circuit.
    struct Path {
        int node, next;
        Word bundles, nodes;
    };

    template <class Item>
    using Table = std::array<std::array<Item, most_vertices>, most_vertices>;

    int nodes_ = 0;
    std::array<int, most_vertices> node_of_{};  // vertex -> its number among the nodes, else -1
    std::array<int, most_vertices> weight_{};   // node -> links that it is: 1 or, if it is a joint, 0
    Table<Strings> strings_{};

    // What was listed for the chain before.
    int listed_nodes_ = 0;
    Table<bool> joined_{};
    Table<int> place_{};            // of the bundle between two nodes
    std::vector<Word> circuits_;    // of three nodes and more, as sets of bundles

    void find_strings(const Chain& chain);
    bool is_listed();
    CircuitEnd list(Watch& watch);
};

}  // namespace gruebler::atlas
