// The atlas without Python, for sanitizers: the two chains of six links, and one with a double joint.
#include <cstdio>
#include <string>
#include <vector>

#include "atlas/chains.hpp"
#include "atlas/mechanisms.hpp"
#include "check.hpp"

using namespace gruebler;
using namespace gruebler::atlas;

namespace {

constexpr std::uint8_t letters[] = {'R'};

using Numbers = std::vector<std::int32_t>;

ChainOutcome describe(std::int64_t hubs, const Numbers& edges, Descriptions& found) {
    const auto size = static_cast<std::int64_t>(edges.size() / 2);
    const Numbers kinds(edges.size() / 2);
    Watch watch{always, nullptr};
    return describe_chains({6, 1, 2, 1, static_cast<int>(size), &hubs, &size, edges.data(), kinds.data(), letters, 1},
                           found, watch);
}

std::string code_of(const Descriptions& found) { return {found.text.begin(), found.text.end()}; }

}  // namespace

int main() {
    const Numbers watt{0, 1, 1, 2, 2, 3, 3, 0, 0, 4, 4, 5, 5, 1}, stephenson{0, 1, 1, 2, 2, 3, 3, 0, 0, 4, 4, 5, 5, 2};
    const Numbers hub{0, 6, 1, 6, 4, 6, 1, 2, 2, 3, 3, 0, 4, 5, 5, 2};  // a double joint and five simple ones
    std::string text;
    std::vector<std::int64_t> ends;
    for (const Numbers& edges : {watt, stephenson}) {
        Descriptions found;
        expect(describe(0, edges, found).end == ChainEnd::done, "a chain was not described");
        const ChainNumbers& numbers = found.numbers[0];
        expect(numbers.group_order == 4, "another group");
        expect(numbers.inversions == (edges == watt ? 2 : 3), "other inversions");
        expect(numbers.smallest_circuit == 4 && numbers.largest_circuit == (edges == watt ? 6 : 5), "other circuits");
        expect(numbers.grows_by_dyads == 1, "it grows by dyads");
        text += code_of(found);
        ends.push_back(static_cast<std::int64_t>(text.size()));
    }
    Descriptions found;
    expect(describe(1, hub, found).end == ChainEnd::done, "a chain with a double joint was not described");
    std::printf("%s\n", code_of(found).c_str());
    for (const Numbers& wrong : {Numbers{0, 9, 1, 2}, Numbers{0, 0, 1, 1}, Numbers{-1, 2, 1, 0}, Numbers{0, 1, 1, 2}}) {
        Descriptions none;
        expect(describe(0, wrong, none).end == ChainEnd::no_chain, "something else was taken for a chain");
    }

    Mechanisms mechanisms;
    Watch watch{always, nullptr};
    const auto* letters_of_codes = reinterpret_cast<const std::uint8_t*>(text.data());
    const MechanismOutcome outcome = list_mechanisms({6, 7, 2, ends.data(), letters_of_codes}, true, mechanisms, watch);
    expect(outcome.end == MechanismEnd::done, "mechanisms were not listed");
    expect(mechanisms.frames.size() == 5, "the six-bars have five inversions");
    expect(mechanisms.driven.size() == 9 * 6, "the six-bars have nine drives");  // two groups, four columns before
    text[5] = 'x';
    Mechanisms none;
    expect(list_mechanisms({6, 7, 2, ends.data(), letters_of_codes}, true, none, watch).end == MechanismEnd::no_code,
           "another text was taken for a code");
}
