#include "atlas/orbits.hpp"

namespace gruebler::atlas {

using namespace bits;

static_assert(most_links * most_links <= most_joints);

OrbitNumbers Orbits::count(const Chain& chain) {
    OrbitNumbers numbers{0, count_joints(chain), count_drives(chain)};
    for (int v = 0; v < chain.links; ++v) numbers.inversions += chain.labeller.answer().orbit_of[v] == v;
    return numbers;
}

int Orbits::count_joints(const Chain& chain) {
    const auto& joints = chain.joints;
    const auto count = static_cast<int>(joints.size());
    int orbits = count;
    for (int i = 0; i < count; ++i) united_.isolate(i);
    for (const auto& generator : chain.labeller.generators()) {
        chain.labeller.write_image(generator, image_);
        for (int j = 0; j < count; ++j) {
            Word moved = 0;
            for (Word set = joints[j].links; set != 0; set = without_lowest(set)) moved |= bit(image_[lowest(set)]);
            if (moved == joints[j].links) continue;
            for (int i = 0; i < count; ++i) {
                if (joints[i].links != moved) continue;
                orbits -= united_.join(i, j);
                break;
            }
        }
    }
    return orbits;
}

int Orbits::count_drives(const Chain& chain) {
    const int n = chain.links;
    int orbits = 0;
    for (const Joint& joint : chain.joints) orbits += size(joint.links) * (size(joint.links) - 1);
    for (int i = 0; i < n * n; ++i) united_.isolate(i);
    for (const auto& generator : chain.labeller.generators()) {
        chain.labeller.write_image(generator, image_);
        for (int u = 0; u < n; ++u)
            for (Word set = chain.near[u]; set != 0; set = without_lowest(set))
                orbits -= united_.join(u * n + lowest(set), image_[u] * n + image_[lowest(set)]);
    }
    return orbits;
}

}  // namespace gruebler::atlas
