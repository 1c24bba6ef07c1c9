#include "structure/groups.hpp"

#include <algorithm>
#include <utility>

#include "labelling/graph_labeller.hpp"
#include "structure/contour.hpp"

namespace gruebler::structure {
namespace {

constexpr int link_colour = 1, turning_colour = 1;  // as gruebler.structure.isomorphism has them
constexpr std::int64_t steps_of_a_group = 1 << 8;  // of the watch, of some nanoseconds

class Groups {
public:
    explicit Groups(const Trusses& trusses)
        : n_(trusses.links), joints_(trusses.joints), labeller_(n_ - 1 + joints_), number_(n_ - 1 + joints_) {
        places_.resize(number_.size());
        edges_.resize(static_cast<std::size_t>(joints_));
    }

    bool describe(const std::uint8_t* ends, std::vector<std::int64_t>& rows, Watch& watch) {
        const std::size_t begin = rows.size(), length = 2 + 2 * edges_.size();
        for (int removed = 0; removed < n_; ++removed) {
            const int order = take_out(removed, ends);
            if (!labeller_.label(watch) || !spend(watch, steps_of_a_group)) return false;
            const int links = number_links(n_ - 1 + order);
            sort_joints();
            if (is_known(rows, begin, length)) continue;
            rows.push_back(contours_.class_of(links, inner_));
            rows.push_back(order);
            for (const auto& [a, b] : sorted_) {
                rows.push_back(a);
                rows.push_back(b);
            }
        }
        return true;
    }

private:
    using Joint = std::pair<int, int>;

    int n_, joints_;
    labelling::GraphLabeller labeller_;
    Contours contours_;
    std::vector<int> number_, places_;  // vertex -> number of the link, from 1, in canonical order; 0 outside
    std::vector<Joint> edges_, sorted_;
    std::vector<InnerJoint> inner_;

    // The truss without a link: each of its joints gets a vertex of its own. Returns their number.
    int take_out(int removed, const std::uint8_t* ends) {
        int order = 0;
        const auto vertex = [&](int link) {
            if (link == removed) return n_ - 1 + order++;
            return link > removed ? link - 1 : link;
        };
        for (int j = 0; j < joints_; ++j) {
            const int u = vertex(ends[2 * j]), v = vertex(ends[2 * j + 1]);
            edges_[j] = {u, v};
        }
        labeller_.begin(n_ - 1 + order, link_colour);
        for (const auto& [u, v] : edges_) labeller_.join(u, v, turning_colour);
        return order;
    }

    int number_links(int vertices) {
        for (int v = 0; v < vertices; ++v) places_[labeller_.place(v)] = v;
        int links = 0;
        for (int i = 0; i < vertices; ++i) number_[places_[i]] = places_[i] < n_ - 1 ? ++links : 0;
        return links;
    }

    // The inner joints come in the order of the truss.
    void sort_joints() {
        sorted_.clear();
        inner_.clear();
        for (const auto& [u, v] : edges_) {
            const auto [a, b] = std::minmax(number_[u], number_[v]);
            sorted_.emplace_back(a, b);
            if (a > 0) inner_.push_back({a - 1, b - 1});
        }
        labelling::sort(sorted_.data(), sorted_.data() + sorted_.size());
    }

    // Whether the group is one of those of the same truss.
    bool is_known(const std::vector<std::int64_t>& rows, std::size_t begin, std::size_t length) const {
        for (std::size_t row = begin; row < rows.size(); row += length) {
            std::size_t j = 0;
            while (j < sorted_.size() && rows[row + 2 + 2 * j] == sorted_[j].first &&
                   rows[row + 3 + 2 * j] == sorted_[j].second)
                ++j;
            if (j == sorted_.size()) return true;
        }
        return false;
    }
};

}  // namespace

bool describe_groups(const Trusses& trusses, std::vector<std::int64_t>& rows, Watch& watch) {
    Groups groups(trusses);
    for (std::int64_t k = 0; k < trusses.count; ++k)
        if (!groups.describe(trusses.ends + k * 2 * trusses.joints, rows, watch)) return false;
    return true;
}

}  // namespace gruebler::structure
