#include "structure/multiple_joints.hpp"

#include <utility>

namespace gruebler::structure {
namespace {

using namespace bits;

constexpr int multiple_colour = 1, simple_colour = 1;  // of a vertex for a joint, and of an edge for one
constexpr int simple = 2;                              // links of a joint

// Calls `visit` with each member of a set, ascending.
template <class Visit>
void each(Word set, const Visit& visit) {
    for (; set != 0; set = without_lowest(set)) visit(lowest(set));
}

// The joints after a merging.
template <class Merging>
void merge(const std::vector<Word>& joints, const Merging& merging, std::vector<Word>& out) {
    out.clear();
    for (const Word joint : joints)
        if (joint != merging.small) out.push_back(joint == merging.big ? joint | merging.small : joint);
}

Word moved(Word set, const std::vector<int>& image) {
    Word result = 0;
    each(set, [&](int v) { result |= bit(image[v]); });
    return result;
}

int multiple(const std::vector<Word>& joints) {
    int count = 0;
    for (const Word joint : joints) count += size(joint) > simple;
    return count;
}

}  // namespace

MultipleJoints::MultipleJoints(int links, int joints, std::vector<Word> simple, const JointLimits& limits)
    : n_(links),
      per_chain_(joints),
      simple_(std::move(simple)),
      limits_(limits),
      levels_(static_cast<std::size_t>(joints) + 1),
      near_(links),
      degree_(links),
      around_(links),
      labeller_(links + joints),
      orbits_(std::max(joints * joints, links * links)) {
    merged_.reserve(joints);
}

bool MultipleJoints::grow(std::int64_t many, std::vector<std::int64_t>& rows, Watch& watch) {
    const auto chains = per_chain_ == 0 ? 0 : static_cast<std::int64_t>(simple_.size()) / per_chain_;
    while (many > 0) {
        if (depth_ < 0) {
            if (chain_ + 1 >= chains) return true;
            ++chain_;
            begin_chain();
        } else if (!levels_[depth_].waiting.empty()) {
            descend();
        } else {
            --depth_;
            continue;
        }
        if (!list_mergings(watch) || !spend(watch, std::int64_t{1} << n_)) {
            depth_ = -1;
            chain_ = chains;
            return false;
        }
        const std::vector<Word>& joints = levels_[depth_].joints;
        if (multiple(joints) < limits_.fewest) continue;
        rows.push_back(chain_);
        rows.insert(rows.end(), joints.begin(), joints.end());
        rows.resize(rows.size() + static_cast<std::size_t>(per_chain_) - joints.size());
        --many;
    }
    return true;
}

// The table of freedoms by the sets with one link less.
void MultipleJoints::begin_chain() {
    depth_ = 0;
    Level& level = levels_[0];
    const auto begin = simple_.begin() + chain_ * per_chain_;
    level.joints.assign(begin, begin + per_chain_);
    level.freedoms.resize(std::size_t{1} << n_);
    level.freedoms[0] = -3;
    for (Word s = 1; s < bit(n_); ++s) {
        const Word rest = without_lowest(s), last = s ^ rest;
        int d = level.freedoms[rest] + 3;
        for (const Word joint : level.joints) d -= (joint & last) != 0 && (joint & rest) != 0 ? 2 : 0;
        level.freedoms[s] = static_cast<std::int8_t>(d);
    }
}

// Does the next merging of a level: the chain of the next one and its table of freedoms.
void MultipleJoints::descend() {
    Level& above = levels_[depth_];
    const Merging merging = above.waiting.back();
    above.waiting.pop_back();
    Level& below = levels_[++depth_];
    merge(above.joints, merging, below.joints);
    below.freedoms = above.freedoms;
    const Word leaving = bit(merging.leaving), others = ones(n_) & ~bit(merging.kept) & ~leaving;
    for (Word s = others; s != 0; s = (s - 1) & others)
        if ((s & merging.big) != 0) below.freedoms[s | leaving] = static_cast<std::int8_t>(below.freedoms[s | leaving] - 2);
}

// The mergings of the present chain that lead to chains of the next level, each up to symmetry.
bool MultipleJoints::list_mergings(Watch& watch) {
    Level& level = levels_[depth_];
    level.waiting.clear();
    list_possible(level);
    if (found_.empty()) return true;
    if (!keep_one_of_each_orbit(level, watch)) return false;
    for (const int i : first_) {
        const Merging& merging = found_[i];
        merge(level.joints, merging, merged_);
        survey(merged_);
        const Split split{size(merging.big) + 1, merging.kept, merging.leaving};
        const int equal = rivals(merged_, split);
        if (equal == 0 || !has_room(level, merging)) continue;
        if (equal > 1) {
            if (!label(merged_, watch)) return false;
            if (!is_canonical(merged_, split)) continue;
        }
        level.waiting.push_back(merging);
    }
    return true;
}

// Every simple joint can be merged with one that shares a link with it, unless the link keeps fewer than two joints or two
// links would share two joints.
void MultipleJoints::list_possible(const Level& level) {
    const int already = multiple(level.joints);
    near_.assign(near_.size(), 0);
    for (const Word joint : level.joints) each(joint, [&](int v) { near_[v] |= joint & ~bit(v); });
    survey(level.joints);
    found_.clear();
    for (const Word big : level.joints) {
        if (size(big) >= limits_.largest || (size(big) == simple && already >= limits_.most)) continue;
        for (const Word small : level.joints) {
            if (small == big || size(small) > simple || size(big & small) != 1) continue;
            const int kept = lowest(big & small), leaving = lowest(small & ~big);
            if (degree_[kept] < 3 || (near_[leaving] & big & ~small) != 0) continue;
            found_.push_back({big, small, kept, leaving});
        }
    }
}

bool MultipleJoints::keep_one_of_each_orbit(const Level& level, Watch& watch) {
    if (!label(level.joints, watch)) return false;
    const auto count = static_cast<int>(found_.size());
    for (int i = 0; i < count; ++i) orbits_.isolate(i);
    for (const auto& generator : labeller_.generators()) {
        labeller_.write_image(generator, image_);
        for (int i = 0; i < count; ++i) {
            const Word big = moved(found_[i].big, image_), small = moved(found_[i].small, image_);
            for (int other = 0; other < count; ++other) {
                if (found_[other].big != big || found_[other].small != small) continue;
                orbits_.join(i, other);
                break;
            }
        }
    }
    first_.clear();
    for (int i = 0; i < count; ++i)
        if (orbits_.is_root(i)) first_.push_back(i);
    return true;
}

// Degrees, and the sum of the squares of the degrees around each link.
void MultipleJoints::survey(const std::vector<Word>& joints) {
    degree_.assign(degree_.size(), 0);
    around_.assign(around_.size(), 0);
    for (const Word joint : joints) each(joint, [&](int v) { ++degree_[v]; });
    for (const Word joint : joints) {
        int squares = 0;
        each(joint, [&](int v) { squares += degree_[v] * degree_[v]; });
        each(joint, [&](int v) { around_[v] += squares; });
    }
}

// The preference of a split: numbers of links and joints only, 6 bits for a number and 14 for a sum of squares.
std::int64_t MultipleJoints::rank(const Split& split) const {
    const auto part = [&](std::int64_t before, int v) { return (before << 6 | degree_[v]) << 14 | around_[v]; };
    return part(part(split.joint_size, split.kept), split.leaving);
}

// How many splits have the preference of this one; 0 if one has a higher.
int MultipleJoints::rivals(const std::vector<Word>& joints, const Split& split) const {
    const std::int64_t own = rank(split);
    int equal = 0;
    for (const Word joint : joints) {
        const int here = size(joint);
        if (here <= simple || here < split.joint_size) continue;
        for (Word us = joint; us != 0; us = without_lowest(us)) {
            for (Word vs = joint & ~bit(lowest(us)); vs != 0; vs = without_lowest(vs)) {
                const std::int64_t other = rank({here, lowest(us), lowest(vs)});
                if (other > own) return 0;
                equal += other == own;
            }
        }
    }
    return equal;
}

// Labels a chain; multiple joints are vertices of another colour.
bool MultipleJoints::label(const std::vector<Word>& joints, Watch& watch) {
    int vertex = n_;
    labeller_.begin(n_ + multiple(joints), 0);
    for (const Word joint : joints) {
        if (size(joint) == simple) {
            labeller_.join(lowest(joint), lowest(without_lowest(joint)), simple_colour);
            continue;
        }
        each(joint, [&](int v) { labeller_.join(v, vertex, 0); });
        labeller_.colour(vertex++, multiple_colour);
    }
    return labeller_.label(watch);
}

// Whether an automorphism of the chain just labelled takes the split to the canonical one: of the preferred ones the first
// by canonical places. Two links share one joint at most, so a split is an ordered pair of links.
bool MultipleJoints::is_canonical(const std::vector<Word>& joints, const Split& split) {
    const std::int64_t own = rank(split);
    std::pair<int, int> best{n_, n_};
    int best_pair = -1;
    const int own_pair = split.kept * n_ + split.leaving;
    for (const Word joint : joints) {
        if (size(joint) != split.joint_size) continue;
        each(joint, [&](int u) {
            each(joint & ~bit(u), [&](int v) {
                if (rank({split.joint_size, u, v}) != own) return;
                const std::pair<int, int> places{labeller_.place(u), labeller_.place(v)};
                if (best_pair >= 0 && places >= best) return;
                best = places;
                best_pair = u * n_ + v;
            });
        });
    }
    if (best_pair == own_pair) return true;
    if (labeller_.generators().empty()) return false;
    for (int i = 0; i < n_ * n_; ++i) orbits_.isolate(i);
    for (const auto& generator : labeller_.generators()) {
        labeller_.write_image(generator, image_);
        for (int u = 0; u < n_; ++u)
            for (int v = 0; v < n_; ++v) orbits_.join(u * n_ + v, image_[u] * n_ + image_[v]);
    }
    return orbits_.root(own_pair) == orbits_.root(best_pair);
}

// Whether d(S) >= 3 for every S that contains the link that leaves and a link of the joint, but not the link that is kept.
bool MultipleJoints::has_room(const Level& level, const Merging& merging) const {
    const Word leaving = bit(merging.leaving), others = ones(n_) & ~bit(merging.kept) & ~leaving;
    for (Word s = others; s != 0; s = (s - 1) & others)
        if ((s & merging.big) != 0 && level.freedoms[s | leaving] < 3) return false;
    return true;
}

}  // namespace gruebler::structure
