// Frames, drives and Assur groups of many chains with F = 1 at once.
//
// Only simple turning joints, and drives at the frame: no links of such a group are rigid among themselves, so the groups
// are the differences of the tight sets, which are the strong components of an orientation (docs/theory/assur.md).
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"

namespace gruebler::atlas {

inline constexpr int most_mechanism_links = 40;   // as many as a chain of the atlas, see chain.hpp
inline constexpr int most_mechanism_joints = 62;  // sets of them are bits of a word

// Codes such as gr1:R(0-1)R(0-2) one after another, each of so many links and joints; `end`: where each of them ends.
struct Codes {
    int links, joints;
    std::int64_t count;
    const std::int64_t* end;
    const std::uint8_t* text;
};

// An orbit of links.
struct MechanismRow {
    std::int32_t chain, frame, frame_joints, orbit;
};

// Columns of an orbit of (frame, driven link), before the numbers of its groups in solving order.
struct DrivenHead {
    std::int32_t chain, frame, driven, groups;
};

// Columns of a kind of Assur group, before its joints in canonical order, two numbers each, zeros behind.
struct GroupHead {
    std::int16_t links, class_number, order, joints;
};

inline int most_groups(int links) { return (links - 2) / 2; }  // of a driven mechanism: two links in each
inline int driven_width(int links) { return 4 + most_groups(links); }
inline int group_width(int joints) { return 4 + 2 * joints; }

struct Mechanisms {
    std::vector<MechanismRow> frames;
    std::vector<std::int32_t> driven;  // rows of driven_width numbers
    std::vector<std::int16_t> groups;  // rows of group_width numbers: each kind once, in the order in which they come
};

enum class MechanismEnd {
    done,
    interrupted,
    no_code,       // another text, or other numbers of links and joints
    no_mechanism,  // a chain that one drive does not determine
};

struct MechanismOutcome {
    MechanismEnd end;
    std::int64_t chain;  // the one at which it ended
};

// Cost: some 3 us for each driven mechanism, if they are asked for.
MechanismOutcome list_mechanisms(const Codes& codes, bool driven, Mechanisms& found, Watch& watch);

}  // namespace gruebler::atlas
