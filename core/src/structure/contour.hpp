// The class of an Assur group: the most joints of a link or, if more, of a contour.
#pragma once

#include <vector>

#include "base/bits.hpp"

namespace gruebler::structure {

inline constexpr int most_inner_joints = 62;  // sets of them are bits of a word

struct InnerJoint {
    int u, v;
};

// The longest loop of a minimum cycle basis (Horton 1987; docs/theory/assur.md). The memory of many such questions.
class Contours {
public:
    // The class of a group of so many links with these joints among them, two at least.
    int class_of(int links, const std::vector<InnerJoint>& joints);

private:
    using Word = bits::Word;

    std::vector<Word> path_, loops_, basis_;
    std::vector<int> queue_, degree_;

    // In joints; 0 without a loop.
    int longest(int links, const std::vector<InnerJoint>& joints);
    int list_loops(int links, const std::vector<InnerJoint>& joints);
    bool add_to_basis(Word loop);
};

}  // namespace gruebler::structure
