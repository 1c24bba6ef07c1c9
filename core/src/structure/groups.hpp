// The Assur groups of many trusses: canonical form and class.
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"

namespace gruebler::structure {

// Of a truss: links are numbered by six bits, joints are bits of a word.
inline constexpr int most_truss_links = 32;
inline constexpr int most_truss_joints = 62;

// `count` trusses of so many links and joints, two bytes a joint: its links, which differ.
struct Trusses {
    int links, joints;
    std::int64_t count;
    const std::uint8_t* ends;
};

// Appends the groups of trusses, each once: class, order, then two numbers for each joint: 0 and the link that carries an
// outer joint, links ascending; then the two links of each inner joint, in order; links from 1. Links of a truss that an
// automorphism exchanges give the same group; the least stands. False if the watch ends the work.
//
// Cost: about 2 us for each link of a truss.
bool describe_groups(const Trusses& trusses, std::vector<std::int64_t>& rows, Watch& watch);

}  // namespace gruebler::structure
