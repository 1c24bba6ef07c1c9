#include "atlas/dyads.hpp"

#include <algorithm>

namespace gruebler::atlas {

using namespace bits;

DyadEnd Dyads::take_away(const Chain& chain, int loops, int mobility, Watch& watch) {
    const bool one_order = mobility <= 1;
    const auto joints = static_cast<std::int64_t>(chain.joints.size());
    after_.assign(1, ones(chain.links));
    for (int dyads = 1; dyads < loops; ++dyads) {
        before_.swap(after_);
        after_.clear();
        for (const Word alive : before_) {
            if (!spend(watch, joints * joints + static_cast<std::int64_t>(after_.size()))) return DyadEnd::interrupted;
            for (std::size_t j = 0; j < chain.joints.size() && (after_.empty() || !one_order); ++j) {
                const Word left = alive & ~chain.joints[j].links;
                if (!is_dyad(chain, j, alive) || !is_closed(chain, left)) continue;
                if (std::find(after_.begin(), after_.end(), left) != after_.end()) continue;
                if (after_.size() == most_remainders) return DyadEnd::too_many;
                after_.push_back(left);
            }
            if (one_order && !after_.empty()) break;
        }
        if (after_.empty()) return DyadEnd::does_not;
    }
    return DyadEnd::grows;
}

// Whether the two links of a joint have one more joint each with the others.
bool Dyads::is_dyad(const Chain& chain, std::size_t inner, Word alive) {
    const Word dyad = chain.joints[inner].links & alive;
    if (size(dyad) != 2) return false;
    int outer = 0;
    Word carried = 0;
    for (std::size_t i = 0; i < chain.joints.size(); ++i) {
        const Word other = chain.joints[i].links & alive, common = other & dyad;
        if (i == inner || common == 0 || size(other) < 2) continue;
        if (common == dyad) return false;
        ++outer;
        carried |= common;
    }
    return outer == 2 && carried == dyad;
}

// Whether these links are connected and each carries two joints at least, joints of one link left out.
bool Dyads::is_closed(const Chain& chain, Word alive) {
    Word once = 0, twice = 0, reached = 0;
    for (const Joint& joint : chain.joints) {
        const Word here = joint.links & alive;
        if (size(here) < 2) continue;
        twice |= once & here;
        once |= here;
        reached = here;
    }
    if (twice != alive) return false;
    for (bool growing = true; growing;) {
        growing = false;
        for (const Joint& joint : chain.joints) {
            const Word here = joint.links & alive;
            if ((here & reached) == 0 || (here & ~reached) == 0) continue;
            reached |= here;
            growing = true;
        }
    }
    return reached == alive;
}

}  // namespace gruebler::atlas
