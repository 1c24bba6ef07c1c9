// Properties of many chains at once.
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"

namespace gruebler::atlas {

// `count` chains of n links; see chain.hpp.
struct Chains {
    int links, mobility, loops;
    std::int64_t count;
    int most_edges;              // edges there is room for
    const std::int64_t* hubs;    // (chain): multiple joints
    const std::int64_t* sizes;   // (chain): edges
    const std::int32_t* edges;   // (chain, edge, 2)
    const std::int32_t* kinds;   // (chain, edge): the place of the pair in the table of letters
    const std::uint8_t* letters;
    int pairs;                   // letters there are
};

struct ChainNumbers {
    std::int64_t group_order, inversions, joint_orbits, drives, smallest_circuit, largest_circuit, diameter;
    std::int64_t grows_by_dyads;  // 1 or 0
};

struct Descriptions {
    std::vector<ChainNumbers> numbers;
    std::vector<std::int64_t> ends;           // where the code of a chain ends in the text
    std::vector<std::uint8_t> text;
    std::vector<std::uint8_t> lines;          // graph6 without a line end, zeros where a joint is multiple
    std::vector<std::uint8_t> certificates;   // most_edges bytes a chain, zeros where a joint is multiple
};

enum class ChainEnd {
    done,
    interrupted,
    no_chain,           // edges beyond the links, too few at a vertex, more links in a joint than there is room for
    too_many_circuits,  // or ways to take dyads away
    no_certificate,     // a part of the chain is overconstrained
    group_too_large,    // for 63 bits
};

struct ChainOutcome {
    ChainEnd end;
    std::int64_t chain;  // the one at which it ended
};

// Cost: some 10 us for a chain of 14 links.
ChainOutcome describe_chains(const Chains& chains, Descriptions& found, Watch& watch);

}  // namespace gruebler::atlas
