#include "atlas/chain.hpp"
#include "atlas/chains.hpp"
#include "atlas/mechanisms.hpp"
#include "counting/graph6.hpp"
#include "doors.hpp"

namespace gruebler::doors {
namespace {

using namespace atlas;

std::string chain_is(std::int64_t k, const char* what) { return "chain " + std::to_string(k) + " " + what; }

nb::tuple describe_chains(int n, int mobility, int loops, const Array<std::int64_t, -1>& hubs,
                          const Array<std::int64_t, -1>& sizes, const Array<std::int32_t, -1, -1, 2>& edges,
                          const Array<std::int32_t, -1, -1>& pairs, const Array<std::uint8_t, -1>& letters) {
    expect(n >= 1 && n <= most_links, "a chain has 1 to 40 links");
    const size_t count = sizes.shape(0), widest = edges.shape(1);
    expect(hubs.shape(0) == count && edges.shape(0) == count && pairs.shape(0) == count && pairs.shape(1) == widest,
           "hubs, sizes, edges and pairs belong to the same chains and edges");
    expect(widest <= most_joints && letters.shape(0) <= most_joints, "there are at most 1891 edges and letters");
    const Chains chains{n, mobility, loops, static_cast<std::int64_t>(count), static_cast<int>(widest), hubs.data(),
                        sizes.data(), edges.data(), pairs.data(), letters.data(),
                        static_cast<int>(letters.shape(0))};
    Descriptions found;
    const auto [end, k] = run([&](Watch& watch) { return atlas::describe_chains(chains, found, watch); });
    if (end == ChainEnd::no_chain)
        throw nb::value_error(chain_is(k, "has a vertex of fewer than two edges, or one that is not there, or a joint of "
                                          "more than nine links").c_str());
    if (end == ChainEnd::group_too_large) throw nb::value_error(chain_is(k, "has too many automorphisms").c_str());
    const auto described = static_cast<size_t>(k), bytes = static_cast<size_t>(counting::graph6_length(n)) - 1;
    found.numbers.resize(described);
    found.ends.resize(described);
    found.text.resize(described > 0 ? static_cast<size_t>(found.ends.back()) : 0);
    const size_t length = found.text.size(), columns = sizeof(ChainNumbers) / sizeof(std::int64_t);
    return nb::make_tuple(hand_over<std::int64_t>(std::move(found.numbers), {described, columns}),
                          hand_over<std::int64_t>(std::move(found.ends), {described}),
                          hand_over<std::uint8_t>(std::move(found.text), {length}),
                          hand_over<std::uint8_t>(std::move(found.lines), {described, bytes}),
                          hand_over<std::uint8_t>(std::move(found.certificates), {described, widest}));
}

nb::tuple list_mechanisms(int n, int joints, const Array<std::uint8_t, -1>& text, const Array<std::int64_t, -1>& ends,
                          bool driven) {
    expect(n >= 2 && n <= most_mechanism_links, "a chain has 2 to 40 links");
    expect(joints >= 0 && joints <= most_mechanism_joints, "a chain has at most 62 joints");
    const size_t count = ends.shape(0);
    expect(count < size_t{1} << 31, "there are too many chains");
    for (size_t k = 0; k < count; ++k)
        expect(ends.data()[k] >= (k > 0 ? ends.data()[k - 1] : 0) &&
                   ends.data()[k] <= static_cast<std::int64_t>(text.shape(0)),
               "ends must ascend to the length of the text at most");
    const Codes codes{n, joints, static_cast<std::int64_t>(count), ends.data(), text.data()};
    Mechanisms found;
    const auto [end, k] = run([&](Watch& watch) { return atlas::list_mechanisms(codes, driven, found, watch); });
    if (end == MechanismEnd::no_code)
        throw nb::value_error(
            chain_is(k, "has a code of another kind, or with other numbers of links and joints").c_str());
    if (end == MechanismEnd::no_mechanism)
        throw nb::value_error(chain_is(k, "is not determined by one drive at the frame").c_str());
    const auto wide = static_cast<size_t>(driven_width(n)), group = static_cast<size_t>(group_width(joints));
    const size_t frames = found.frames.size(), rows = found.driven.size() / wide, groups = found.groups.size() / group;
    return nb::make_tuple(hand_over<std::int32_t>(std::move(found.frames), {frames, size_t{4}}),
                          hand_over<std::int32_t>(std::move(found.driven), {rows, wide}),
                          hand_over<std::int16_t>(std::move(found.groups), {groups, group}));
}

}  // namespace

void add_atlas(nb::module_& module) {
    module.def("describe_chains", describe_chains, nb::arg("n"), nb::arg("mobility"), nb::arg("loops"),
               nb::arg("hubs").noconvert(), nb::arg("sizes").noconvert(), nb::arg("edges").noconvert(),
               nb::arg("pairs").noconvert(), nb::arg("letters").noconvert(),
               "Properties of chains of n links: numbers int64[m, 8] (order of the group, inversions, orbits of joints, "
               "drives, links of the smallest and of the largest circuit, diameter, whether it grows by dyads), where the "
               "code of each ends int64[m] in a text uint8, graph6 without line ends uint8[m, bytes], and certificates "
               "uint8[m, e], both where all joints are simple. Fewer chains than given: the next one has too many "
               "circuits.\n\n"
               "hubs, sizes: int64[k], multiple joints and edges of each chain; edges: int32[k, e, 2], a link and, behind "
               "it, a link or a multiple joint, numbered from n on; pairs: int32[k, e], the place of the pair of each edge "
               "among the letters, uint8.");
    module.def("list_mechanisms", list_mechanisms, nb::arg("n"), nb::arg("joints"), nb::arg("text").noconvert(),
               nb::arg("ends").noconvert(), nb::arg("driven"),
               "The mechanisms and, if asked for, the driven mechanisms of chains with F = 1 and simple turning joints: "
               "int32[m, 4], chain, frame, its joints, links in the orbit; int32[d, 3 + 1 + groups], chain, frame, driven "
               "link, how many groups and which, in solving order; int16[g, 4 + 2 joints], the groups: links, class, "
               "order, how many joints and which, two canonical numbers each.\n\n"
               "text: uint8, the codes one after another; ends: int64[k], where each of them ends.");
}

}  // namespace gruebler::doors
