#include "atlas/mechanisms.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <utility>

#include "atlas/group_table.hpp"
#include "base/bits.hpp"
#include "labelling/graph_labeller.hpp"
#include "structure/contour.hpp"

namespace gruebler::atlas {
namespace {

using namespace bits;

constexpr int link_colour = 1, turning_colour = 1;  // as gruebler.structure.isomorphism has them
constexpr int freedoms = 3;                         // of a body: constraints that it takes
constexpr int constraints = 2;                      // of a joint

struct Joint {
    int u, v;

    bool inside() const { return u == v; }  // of the body that the driven link and the frame have become
    int other(int end) const { return u + v - end; }
};

class Lister {
public:
    Lister(const Codes& codes, Mechanisms& found)
        : n_(codes.links),
          count_(codes.joints),
          found_(found),
          table_(codes.joints, found.groups),
          labeller_(n_ + 2 * codes.joints),
          orbits_(n_ * n_),
          orbit_size_(static_cast<std::size_t>(n_ * n_)),
          row_(static_cast<std::size_t>(group_width(codes.joints))) {
        joints_.resize(static_cast<std::size_t>(count_));
        bodies_.resize(joints_.size());
        taken_.resize(joints_.size());
    }

    MechanismEnd list(std::int32_t chain, const std::uint8_t* text, const std::uint8_t* end, bool driven, Watch& watch) {
        if (!read(text, end)) return MechanismEnd::no_code;
        near_.fill(0);
        labeller_.begin(n_, link_colour);
        for (const Joint& joint : joints_) {
            near_[joint.u] |= bit(joint.v);
            near_[joint.v] |= bit(joint.u);
            labeller_.join(joint.u, joint.v, turning_colour);
        }
        if (!labeller_.label(watch)) return MechanismEnd::interrupted;
        list_frames(chain);
        return driven ? list_driven(chain, watch) : MechanismEnd::done;
    }

private:
    int n_, count_;
    Mechanisms& found_;
    GroupTable table_;
    labelling::GraphLabeller labeller_;
    labelling::Orbits orbits_;
    structure::Contours contours_;

    std::vector<Joint> joints_, bodies_;                   // between links; between bodies
    std::array<Word, most_mechanism_links> near_{};        // link -> its neighbours
    std::vector<int> orbit_size_, image_, queue_;
    std::vector<std::pair<int, int>> drives_;
    std::vector<std::array<int, constraints>> taken_;      // joint -> the bodies that take its constraints
    std::array<int, most_mechanism_links> load_{}, before_{}, number_{};
    std::array<Word, most_mechanism_links> needs_{};       // body -> those on which it depends
    std::vector<structure::InnerJoint> inner_;
    std::vector<Joint> edges_;
    std::vector<std::pair<int, int>> sorted_;
    std::vector<std::int16_t> row_;

    static bool take_number(const std::uint8_t*& at, const std::uint8_t* end, int& value) {
        const std::uint8_t* begin = at;
        for (value = 0; at < end && *at >= '0' && *at <= '9' && value < most_mechanism_links; ++at)
            value = 10 * value + *at - '0';
        return at > begin;
    }

    static bool take(const std::uint8_t*& at, const std::uint8_t* end, char letter) {
        return at < end && *at++ == static_cast<std::uint8_t>(letter);
    }

    bool read(const std::uint8_t* at, const std::uint8_t* end) {
        for (const char letter : {'g', 'r', '1', ':'})
            if (!take(at, end, letter)) return false;
        for (Joint& joint : joints_) {
            if (!take(at, end, 'R') || !take(at, end, '(') || !take_number(at, end, joint.u) || !take(at, end, '-') ||
                !take_number(at, end, joint.v) || !take(at, end, ')'))
                return false;
            if (joint.u >= n_ || joint.v >= n_ || joint.u == joint.v) return false;
        }
        return at == end;
    }

    // Orbits of links, or of ordered pairs of them.
    void unite(bool pairs) {
        const int size = pairs ? n_ * n_ : n_;
        for (int i = 0; i < size; ++i) orbits_.isolate(i);
        for (const auto& generator : labeller_.generators()) {
            labeller_.write_image(generator, image_);
            for (int i = 0; i < size; ++i) orbits_.join(i, pairs ? image_[i / n_] * n_ + image_[i % n_] : image_[i]);
        }
        std::fill(orbit_size_.begin(), orbit_size_.begin() + size, 0);
        for (int i = 0; i < size; ++i) ++orbit_size_[orbits_.root(i)];
    }

    void list_frames(std::int32_t chain) {
        unite(false);
        for (int v = 0; v < n_; ++v)
            if (orbit_size_[v] > 0) found_.frames.push_back({chain, v, size(near_[v]), orbit_size_[v]});
    }

    MechanismEnd list_driven(std::int32_t chain, Watch& watch) {
        unite(true);
        drives_.clear();
        for (int i = 0; i < n_ * n_; ++i)
            if (orbit_size_[i] > 0 && has(near_[i / n_], i % n_)) drives_.emplace_back(i / n_, i % n_);
        for (const auto& [frame, driven] : drives_) {
            const MechanismEnd end = solve(chain, frame, driven, watch);
            if (end != MechanismEnd::done) return end;
        }
        return MechanismEnd::done;
    }

    // The groups in solving order, as a row.
    MechanismEnd solve(std::int32_t chain, int frame, int driven, Watch& watch) {
        const auto body = [=](int link) { return link == driven ? frame : link; };
        for (int j = 0; j < count_; ++j) bodies_[j] = {body(joints_[j].u), body(joints_[j].v)};
        if (!distribute(frame)) return MechanismEnd::no_mechanism;
        find_needs();
        const std::size_t first = found_.driven.size();
        found_.driven.resize(first + static_cast<std::size_t>(driven_width(n_)));
        Word done = bit(frame), rest = ones(n_) & ~bit(frame) & ~bit(driven);
        int groups = 0;
        while (rest != 0) {
            const Word group = next_group(done, rest);
            if (groups == most_groups(n_)) return MechanismEnd::no_mechanism;
            const std::int32_t number = number_of(group, watch);
            if (number < 0) return MechanismEnd::interrupted;
            found_.driven[first + 4 + groups++] = number;
            done |= group;
            rest &= ~group;
        }
        const DrivenHead head{chain, frame, driven, groups};
        std::memcpy(found_.driven.data() + first, &head, sizeof head);
        return MechanismEnd::done;
    }

    // Distributes the constraints: three to each body but the base, each constraint to a body of its joint; false if they
    // are too many.
    bool distribute(int base) {
        load_.fill(0);
        for (auto& pair : taken_) pair.fill(-1);
        for (int j = 0; j < count_; ++j) {
            if (bodies_[j].inside()) continue;
            for (int& taker : taken_[j]) {
                int goal = find_room(bodies_[j], base);
                if (goal < 0) return false;
                ++load_[goal];
                while (before_[goal] >= 0) {
                    int& changed = taken_[before_[goal] / constraints][before_[goal] % constraints];
                    std::swap(changed, goal);
                }
                taker = goal;
            }
        }
        return true;
    }

    // A body with room, by a path from one of the ends over constraints that can change their body, each of which stands
    // in `before_`; -1 if there is none.
    int find_room(const Joint& joint, int base) {
        constexpr int start = -1, unseen = -2;
        before_.fill(unseen);
        queue_.clear();
        const auto reach = [&](int body, int by) {
            if (body == base || before_[body] != unseen) return;
            before_[body] = by;
            queue_.push_back(body);
        };
        reach(joint.u, start);
        reach(joint.v, start);
        for (std::size_t k = 0; k < queue_.size(); ++k) {
            const int v = queue_[k];
            if (load_[v] < freedoms) return v;
            for (int j = 0; j < count_; ++j)
                for (int c = 0; c < constraints; ++c)
                    if (taken_[j][c] == v) reach(bodies_[j].other(v), constraints * j + c);
        }
        return -1;
    }

    // The transitive closure.
    void find_needs() {
        for (int v = 0; v < n_; ++v) needs_[v] = bit(v);
        for (int j = 0; j < count_; ++j)
            if (!bodies_[j].inside())
                for (const int v : taken_[j]) needs_[v] |= bit(bodies_[j].other(v));
        for (int k = 0; k < n_; ++k)
            for (int v = 0; v < n_; ++v)
                if (has(needs_[v], k)) needs_[v] |= needs_[k];
    }

    // Of the groups that can be solved now, the one with the first body.
    Word next_group(Word done, Word rest) const {
        Word group = 0;
        for (Word waiting = rest; waiting != 0; waiting &= ~group) {
            const int v = lowest(waiting);
            group = 0;
            for (Word others = needs_[v] & rest; others != 0; others = without_lowest(others))
                if (has(needs_[lowest(others)], v)) group |= bit(lowest(others));
            if ((needs_[v] & ~(done | group)) == 0) break;
        }
        return group;
    }

    // The number of a group of bodies in the table; -1 if the watch ends the work.
    std::int32_t number_of(Word group, Watch& watch) {
        const int links = number_bodies(group), order = list_joints(group, links);
        labeller_.begin(links + order, link_colour);
        for (const Joint& joint : edges_) labeller_.join(joint.u, joint.v, turning_colour);
        if (!labeller_.label(watch) || !spend(watch, count_)) return -1;
        sorted_.clear();
        for (const Joint& joint : edges_)
            sorted_.push_back(std::minmax({labeller_.place(joint.u), labeller_.place(joint.v)}));
        labelling::sort(sorted_.data(), sorted_.data() + sorted_.size());
        std::fill(row_.begin(), row_.end(), std::int16_t{0});
        for (std::size_t j = 0; j < sorted_.size(); ++j) {
            row_[4 + 2 * j] = static_cast<std::int16_t>(sorted_[j].first);
            row_[5 + 2 * j] = static_cast<std::int16_t>(sorted_[j].second);
        }
        bool added;
        const std::int32_t number = table_.find(row_, added);
        if (added) {
            const GroupHead head{static_cast<std::int16_t>(links),
                                 static_cast<std::int16_t>(contours_.class_of(links, inner_)),
                                 static_cast<std::int16_t>(order), static_cast<std::int16_t>(edges_.size())};
            std::memcpy(table_.at(number), &head, sizeof head);
        }
        return number;
    }

    int number_bodies(Word group) {
        int links = 0;
        for (int v = 0; v < n_; ++v) number_[v] = has(group, v) ? links++ : -1;
        return links;
    }

    // The joints of a group; one with a body solved before gets a vertex of its own there, one with a later body is none of
    // its. Returns the number of outer joints.
    int list_joints(Word group, int links) {
        int order = 0;
        edges_.clear();
        inner_.clear();
        for (int j = 0; j < count_; ++j) {
            const int u = number_[bodies_[j].u], v = number_[bodies_[j].v];
            if (bodies_[j].inside() || (u < 0 && v < 0)) continue;
            if (u >= 0 && v >= 0) {
                inner_.push_back({u, v});
                edges_.push_back({u, v});
            } else if (has(group, taken_[j][0])) {
                edges_.push_back({links + order++, std::max(u, v)});
            }
        }
        return order;
    }
};

}  // namespace

MechanismOutcome list_mechanisms(const Codes& codes, bool driven, Mechanisms& found, Watch& watch) {
    const std::unique_ptr<Lister> lister(new Lister(codes, found));
    const std::uint8_t* begin = codes.text;
    for (std::int64_t k = 0; k < codes.count; ++k) {
        const std::uint8_t* end = codes.text + codes.end[k];
        const MechanismEnd ended = lister->list(static_cast<std::int32_t>(k), begin, end, driven, watch);
        if (ended != MechanismEnd::done) return {ended, k};
        begin = end;
    }
    return {MechanismEnd::done, codes.count};
}

}  // namespace gruebler::atlas
