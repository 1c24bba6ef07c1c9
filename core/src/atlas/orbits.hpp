// The orbits of links, joints and drives of a chain under its automorphisms.
#pragma once

#include <vector>

#include "atlas/chain.hpp"

namespace gruebler::atlas {

struct OrbitNumbers {
    int inversions, joints;
    int drives;  // (frame, joint at it, link that the joint drives): ordered pairs of links that share a joint
};

class Orbits {
public:
    // For a chain that has been labelled. Two of its links share one joint at most.
    OrbitNumbers count(const Chain& chain);

private:
    labelling::Orbits united_{most_joints};
    std::vector<int> image_;

    int count_joints(const Chain& chain);
    int count_drives(const Chain& chain);
};

}  // namespace gruebler::atlas
