#include "atlas/chains.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>

#include "atlas/certificate.hpp"
#include "atlas/circuits.hpp"
#include "atlas/dyads.hpp"
#include "atlas/orbits.hpp"
#include "counting/graph6.hpp"

namespace gruebler::atlas {
namespace {

using namespace bits;

class Describer {
public:
    explicit Describer(const Chains& chains)
        : all_(chains), line_(static_cast<std::size_t>(counting::graph6_length(chains.links))) {}

    ChainEnd describe(std::int64_t k, Descriptions& found, Watch& watch) {
        const auto most = static_cast<std::size_t>(all_.most_edges);
        if (!read(k)) return ChainEnd::no_chain;
        if (!chain_.labeller.label(watch)) return ChainEnd::interrupted;
        ChainNumbers& numbers = found.numbers.emplace_back();
        if (!multiply_factors(numbers.group_order)) return ChainEnd::group_too_large;
        const OrbitNumbers orbits = orbits_.count(chain_);
        numbers.inversions = orbits.inversions;
        numbers.joint_orbits = orbits.joints;
        numbers.drives = orbits.drives;
        numbers.diameter = diameter();
        const DyadEnd dyads = dyads_.take_away(chain_, all_.loops, all_.mobility, watch);
        if (dyads == DyadEnd::interrupted) return ChainEnd::interrupted;
        if (dyads == DyadEnd::too_many) return ChainEnd::too_many_circuits;
        numbers.grows_by_dyads = dyads == DyadEnd::grows;
        const CircuitEnd circuits = circuits_.measure(chain_, watch);
        if (circuits == CircuitEnd::interrupted) return ChainEnd::interrupted;
        if (circuits == CircuitEnd::too_many) return ChainEnd::too_many_circuits;
        numbers.smallest_circuit = circuits_.smallest;
        numbers.largest_circuit = circuits_.largest;
        sort_joints();
        write_code(found.text);
        found.ends.push_back(static_cast<std::int64_t>(found.text.size()));
        found.lines.resize(found.lines.size() + line_.size() - 1);
        found.certificates.resize(found.certificates.size() + most);
        if (chain_.hubs > 0) return ChainEnd::done;
        write_line(found.lines.data() + found.lines.size() - (line_.size() - 1));
        const bool certified =
            certificates_.certify(all_.links, ends_, found.certificates.data() + found.certificates.size() - most);
        return certified ? ChainEnd::done : ChainEnd::no_certificate;
    }

private:
    // A joint with its links by canonical numbers, ascending.
    struct SortedJoint {
        std::array<int, most_members + 1> numbers;  // from 1, behind them 0
        int kind;

        bool operator<(const SortedJoint& other) const { return numbers < other.numbers; }
    };

    const Chains& all_;
    Chain chain_;
    Orbits orbits_;
    Dyads dyads_;
    Circuits circuits_;
    Certificates certificates_;
    std::vector<SortedJoint> sorted_;
    std::vector<Ends> ends_;
    std::vector<std::uint8_t> line_;  // its end included

    bool read(std::int64_t k) {
        const std::int64_t size = all_.sizes[k], first = k * all_.most_edges;
        if (size < 0 || size > all_.most_edges) return false;
        for (std::int64_t e = first; e < first + size; ++e)
            if (all_.kinds[e] < 0 || all_.kinds[e] >= all_.pairs) return false;
        return chain_.read(all_.links, all_.hubs[k], static_cast<int>(size), all_.edges + 2 * first, all_.kinds + first);
    }

    bool multiply_factors(std::int64_t& order) const {
        order = 1;
        for (const std::int64_t factor : chain_.labeller.answer().factors) {
            if (order > std::numeric_limits<std::int64_t>::max() / factor) return false;
            order *= factor;
        }
        return true;
    }

    // The most joints on a shortest path between two links.
    int diameter() const {
        int most = 0;
        for (int start = 0; start < chain_.links; ++start) {
            Word reached = bit(start);
            int steps = 0;
            for (Word front = reached; front != 0; ++steps) {
                Word fresh = 0;
                for (Word set = front; set != 0; set = without_lowest(set)) fresh |= chain_.near[lowest(set)];
                front = fresh & ~reached;
                reached |= front;
            }
            most = std::max(most, steps - 1);
        }
        return most;
    }

    // The canonical order of the joints.
    void sort_joints() {
        sorted_.clear();
        ends_.clear();
        for (const Joint& joint : chain_.joints) {
            Word places = 0;
            for (Word set = joint.links; set != 0; set = without_lowest(set))
                places |= bit(chain_.labeller.place(lowest(set)));
            SortedJoint& sorted = sorted_.emplace_back(SortedJoint{{}, joint.kind});
            for (int i = 0; places != 0; places = without_lowest(places)) sorted.numbers[i++] = lowest(places) + 1;
        }
        labelling::sort(sorted_.data(), sorted_.data() + sorted_.size());
        if (chain_.hubs > 0) return;
        for (const SortedJoint& joint : sorted_) ends_.push_back({joint.numbers[0] - 1, joint.numbers[1] - 1});
    }

    // Such as gr1:R(0-1)R(0-2)...
    void write_code(std::vector<std::uint8_t>& text) const {
        const auto write = [&text](const auto& letters) { text.insert(text.end(), letters.begin(), letters.end()); };
        write(std::string("gr1:"));
        for (const SortedJoint& joint : sorted_) {
            text.push_back(all_.letters[joint.kind]);
            for (int i = 0; joint.numbers[i] > 0; ++i) {
                text.push_back(i == 0 ? '(' : '-');
                write(std::to_string(joint.numbers[i] - 1));
            }
            text.push_back(')');
        }
    }

    void write_line(std::uint8_t* to) {
        counting::begin_graph6(all_.links, line_.data());
        for (const Ends& ends : ends_)
            counting::add_graph6_edge(ends.u, ends.v, counting::graph6_head(all_.links), line_.data());
        std::copy(line_.begin(), line_.end() - 1, to);
    }
};

}  // namespace

ChainOutcome describe_chains(const Chains& chains, Descriptions& found, Watch& watch) {
    const std::unique_ptr<Describer> describer(new Describer(chains));
    for (std::int64_t k = 0; k < chains.count; ++k) {
        const ChainEnd end = describer->describe(k, found, watch);
        if (end != ChainEnd::done) return {end, k};
    }
    return {ChainEnd::done, chains.count};
}

}  // namespace gruebler::atlas
