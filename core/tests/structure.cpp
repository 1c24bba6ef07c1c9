// Multiple joints, sliding joints and Assur groups without Python, for sanitizers: small numbers in print.
#include <cstdio>
#include <vector>

#include "check.hpp"
#include "structure/assembly_modes.hpp"
#include "structure/groups.hpp"
#include "structure/multiple_joints.hpp"
#include "structure/sliding.hpp"

using namespace gruebler;
using namespace gruebler::structure;

namespace {

using Ends = std::vector<std::uint8_t>;

constexpr int joints_of_six = 7;
const Ends watt{0, 1, 1, 2, 2, 3, 3, 0, 0, 4, 4, 5, 5, 1}, stephenson{0, 1, 1, 2, 2, 3, 3, 0, 0, 4, 4, 5, 5, 2};

std::vector<bits::Word> sets_of(const Ends& ends) {
    std::vector<bits::Word> sets;
    for (std::size_t i = 0; i < ends.size(); i += 2) sets.push_back(bits::bit(ends[i]) | bits::bit(ends[i + 1]));
    return sets;
}

// Six links, F = 1: 2 chains of simple joints, one with a double joint, one with two.
void multiple_joints(Watch& watch) {
    std::vector<bits::Word> simple = sets_of(watt), other = sets_of(stephenson);
    simple.insert(simple.end(), other.begin(), other.end());
    MultipleJoints search(6, joints_of_six, simple, {0, 99, 99});
    std::vector<std::int64_t> rows;
    for (int k = 1; k <= 4; ++k) {
        expect(search.grow(1, rows, watch), "a search did not go on");
        expect(rows.size() == static_cast<std::size_t>(k * (joints_of_six + 1)), "a chain is missing");
    }
    expect(search.grow(9, rows, watch) && rows.size() == 4 * (joints_of_six + 1), "there is a fifth chain");
    MultipleJoints stopped(6, joints_of_six, simple, {0, 99, 99});
    Watch impatient{never, nullptr, 1};
    expect(!stopped.grow(9, rows, impatient), "a search went on after it was to end");
}

// The four-bar in general position: one choice without a slide, four with one, six with two, none with more.
void sliding_joints(Watch& watch) {
    constexpr int columns = 4, rows = 3;
    const std::int64_t x[] = {0, 5, 7, 2}, y[] = {0, 1, 6, 4};
    std::vector<std::int64_t> vectors, joint{0, 1, 2, 3}, images{0, 1, 2, 3};
    for (int k = 0; k < columns; ++k) vectors.insert(vectors.end(), {1, y[k], static_cast<std::int64_t>(prime) - x[k] * (x[k] > 0)});
    for (int k = 0; k < columns; ++k) {
        if (x[k] == 0) vectors[rows * k + 2] = 0;
        vectors.insert(vectors.end(), {0, 3 + 2 * k, 1 + k * k});
    }
    const ClosureColumns chain{columns, rows, columns, vectors.data(), joint.data(), 1, images.data()};
    const auto sums = count_sliding(chain, 1, watch);
    expect(sums == std::vector<std::int64_t>({1, 4, 6, 0, 0}), "other numbers of slides at a four-bar");
    Watch impatient{never, nullptr, 1};
    expect(count_sliding(chain, 1, impatient).empty(), "a count went on after it was to end");
}

// The triangle gives the dyad; the truss of five links with a triangle, two groups of four links.
void assur_groups(Watch& watch) {
    const Ends triangle{0, 1, 1, 2, 2, 0}, five{0, 1, 0, 2, 0, 3, 1, 2, 1, 4, 3, 4};
    std::vector<std::int64_t> rows;
    expect(describe_groups({3, 3, 1, triangle.data()}, rows, watch), "groups did not end");
    expect(rows == std::vector<std::int64_t>({2, 2, 0, 1, 0, 2, 1, 2}), "another dyad");
    rows.clear();
    expect(describe_groups({5, 6, 1, five.data()}, rows, watch), "groups did not end");
    expect(!rows.empty() && rows.size() % 14 == 0, "no groups of a truss");
}

// The triangle has two modes; 3-RR six in the plane (Hunt 1983), eight on the sphere (Gosselin 1994).
void assembly_modes(Watch& watch) {
    const JointSets triangle{3, 6, 5}, five{3, 5, 9, 18, 20, 24};
    PlanarModes three(3), planar(5);
    expect(three.count(triangle, watch) == 2 && count_spherical_modes(3, triangle, watch) == 2, "another triangle");
    expect(planar.count(five, watch) == 6 && count_spherical_modes(5, five, watch) == 8, "other modes of 3-RR");
    Watch impatient{never, nullptr, 1};
    expect(!planar.count(five, impatient), "a count went on after it was to end");
    Watch hurried{never, nullptr, 1};
    expect(!count_spherical_modes(5, five, hurried), "a count went on after it was to end");
}

}  // namespace

int main() {
    Watch watch{always, nullptr};
    multiple_joints(watch);
    sliding_joints(watch);
    assur_groups(watch);
    assembly_modes(watch);
    std::printf("multiple joints, sliding joints, Assur groups, assembly modes\n");
}
