#include "counting/listing.hpp"

#include <cstring>
#include <memory>
#include <utility>

#include "counting/graph6.hpp"
#include "counting/reading.hpp"
#include "counting/symmetry.hpp"
#include "counting/walk.hpp"

namespace gruebler::counting {
namespace {

constexpr int most_links = 2 * most_loops + 1 + most_mobility;
constexpr int most_joints = 3 * most_loops + most_mobility;

// Rows of bytes one after another, in memory that is doubled when it is full.
class Rows {
public:
    static constexpr std::size_t slack = 8;  // bytes behind a row that may be written too

    explicit Rows(std::vector<std::uint8_t>& bytes) : bytes_(bytes), used_(bytes.size()) {}
    ~Rows() { bytes_.resize(used_); }

    std::uint8_t* add(std::size_t length) {
        if (bytes_.size() < used_ + length + slack) bytes_.resize(2 * (used_ + length + slack));
        return bytes_.data() + std::exchange(used_, used_ + length);
    }

private:
    std::vector<std::uint8_t>& bytes_;
    std::size_t used_;
};

// Writes assignments, each from the first bundle on that has another value than in the one before.
class Writer {
public:
    Writer(int links, int joints, Form form)
        : lines_(form == Form::lines), length_(lines_ ? graph6_length(links) : 2 * joints), head_(graph6_head(links)) {
        if (lines_) begin_graph6(links, stages_[0].row.data());
    }

    void write(const Frame& frame, const Walk& walk, Rows& rows) {
        const int last = frame.bundles - 1;
        stages_[0].links = frame.nodes;
        for (int b = walk.changed; b < last; ++b)
            extend(frame.bundle[b], walk.value(b), stages_[b], stages_[b + 1], stages_[b + 1].row.data());
        extend(frame.bundle[last], walk.value(last), stages_[last], stages_[last + 1],
               rows.add(static_cast<std::size_t>(length_)));
    }

private:
    static constexpr int longest = (most_links * (most_links - 1) / 2 + 5) / 6 + 8;  // as a line; edges are fewer bytes
    static_assert(longest >= 2 * most_joints);

    // What the first bundles have come to.
    struct Stage {
        int links = 0, joints = 0;
        std::array<std::uint8_t, longest + Rows::slack> row{};
    };

    bool lines_;
    int length_, head_;
    std::array<Stage, most_lanes + 1> stages_{};

    // A copy in words: the length of a row is small and not known to the compiler.
    void copy(const std::uint8_t* from, std::uint8_t* to) const {
        for (int i = 0; i < length_; i += static_cast<int>(Rows::slack)) std::memcpy(to + i, from + i, Rows::slack);
    }

    void extend(const Bundle& bundle, const BundleValue& value, const Stage& before, Stage& after,
                std::uint8_t* row) const {
        copy(before.row.data(), row);
        int links = before.links, joints = before.joints;
        const auto add = [&](int u, int v) {
            if (lines_) return add_graph6_edge(u, v, head_, row);
            row[2 * joints] = static_cast<std::uint8_t>(u);
            row[2 * joints + 1] = static_cast<std::uint8_t>(v);
            ++joints;
        };
        for (int i = 0; i < value.strings; ++i) {
            int here = bundle.u;
            for (int k = 0; k < value.weights[i]; ++k) {
                add(here, links);
                here = links++;
            }
            add(here, bundle.v);
        }
        after.links = links;
        after.joints = joints;
    }
};

class Lister {
public:
    Lister(int loops, int mobility, Form form)
        : loops_(loops),
          mobility_(mobility),
          values_(loops + 1, mobility, 2),
          pair_values_(loops + 1, mobility, mobility == 0 ? most_cost : 2),
          writer_(links_of(loops, mobility), joints_of(loops, mobility), form) {}

    ListEnd list(const std::uint64_t* words, int width, Rows& rows, Watch& watch) {
        if (!read_graph(words, width, loops_, graph_)) return ListEnd::no_contracted_graph;
        if (!frame_.survey(graph_)) return ListEnd::too_many_sets;
        if (!find_images()) return ListEnd::too_many_automorphisms;
        // Between two nodes alone F = 0 allows c = 3.
        walk_.begin(frame_, frame_.nodes == 2 ? pair_values_ : values_, mobility_);
        int unwritten = 0;  // the first bundle that has changed since an assignment was written
        while (true) {
            const Walk::Step step = walk_.next(watch, [this](int known) { return !is_first(known); });
            if (step == Walk::Step::interrupted) return ListEnd::interrupted;
            if (step == Walk::Step::over) return spend(watch, steps_of_a_graph) ? ListEnd::done : ListEnd::interrupted;
            walk_.changed = std::min(walk_.changed, unwritten);
            unwritten = walk_.changed;
            if (!is_first(frame_.bundles)) continue;
            writer_.write(frame_, walk_, rows);
            unwritten = frame_.bundles;
        }
    }

private:
    static constexpr std::int64_t steps_of_a_graph = 1 << 10;  // of the watch, of some nanoseconds

    int loops_, mobility_;
    AllValues values_, pair_values_;
    PackedGraph graph_;
    Frame frame_;
    Symmetry symmetry_;
    int group_ = 0;
    std::array<std::array<std::uint8_t, most_lanes>, most_automorphisms> images_;  // (automorphism, bundle): its image
    Walk walk_;
    Writer writer_;

    bool find_images() {
        group_ = symmetry_.find(frame_.nodes, frame_.around.near, graph_);
        for (int g = 1; g < group_; ++g) {
            Vertices image{};
            symmetry_.image(frame_.nodes, g, image);
            for (int b = 0; b < frame_.bundles; ++b) {
                const Bundle& bundle = frame_.bundle[b];
                images_[g][b] = static_cast<std::uint8_t>(frame_.bundle_between[image[bundle.u]][image[bundle.v]]);
            }
        }
        return group_ > 0;
    }

    // Whether no automorphism makes the assignment lexicographically smaller, as far as the first values tell.
    bool is_first(int known) const {
        for (int g = 1; g < group_; ++g) {
            const auto& image = images_[g];
            for (int b = 0; b < known && image[b] < known; ++b) {
                const int difference = walk_.number(image[b]) - walk_.number(b);
                if (difference < 0) return false;
                if (difference > 0) break;
            }
        }
        return true;
    }
};

}  // namespace

ListOutcome list_chains(const GraphRows& graphs, int loops, int mobility, Form form, std::vector<std::uint8_t>& bytes,
                        Watch& watch) {
    const std::unique_ptr<Lister> lister(new Lister(loops, mobility, form));
    Rows rows(bytes);
    for (std::int64_t k = 0; k < graphs.count; ++k) {
        const ListEnd end = lister->list(graphs.words + k * graphs.width, graphs.width, rows, watch);
        if (end != ListEnd::done) return {end, k};
    }
    return {ListEnd::done, graphs.count};
}

}  // namespace gruebler::counting
