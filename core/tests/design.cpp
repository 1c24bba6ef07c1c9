// Kernels of design without Python, for sanitizers: a slider-crank by its closed form, a parallelogram, two rods on a base, a
// straight curve, a corner of two limits, refusals.
#include <cmath>
#include <cstdio>
#include <vector>

#include "check.hpp"
#include "design/crank_dyads.hpp"
#include "design/limited_steps.hpp"
#include "design/pose_closing.hpp"
#include "design/sampled_curves.hpp"

using namespace gruebler;
using namespace gruebler::design;

int main() {
    Watch watch{always, nullptr};
    const Lanes lanes{baseline::turn_crank, baseline::place_rrr};
    const double side = 1, angles[2] = {0.3, 1.2};
    const std::vector<std::int64_t> watched{0};
    // The crank of 1, the rod of 3, the guide along the x axis; elements are those of each joint in turn.
    const Complex own[8] = {{0, 0}, {0, 0}, {1, 0}, {0, 0}, {3, 0}, {0, 0}, {0, 0}, {0, 0}};
    const std::vector<Complex> lines(8, Complex{1, 0});
    const CrankDyad slider{Form::rrp, {2, 3}, {1, 0}, {2, 6}, {3, 7}, {4, 5}};
    Linkages all{{0, 1, 0, 1}, &slider, 1, 4, 8, 1, own, lines.data(), &side, angles, 2, lanes};
    expect(fault(all).empty(), "a slider-crank is refused");
    Complex turns[8], shifts[8];
    expect(move_planes(all, turns, shifts, watch), "it is interrupted");
    for (int i = 0; i < 2; ++i) {
        const double s = std::sin(angles[i]), reach = std::cos(angles[i]) + std::sqrt(9 - s * s);
        expect(std::abs(shifts[6 + i].x - reach) < 1e-14 && std::abs(shifts[6 + i].y) < 1e-14, "the slider is elsewhere");
    }
    double cosines[2];
    expect(find_cosines(all, watched, cosines, watch) && std::abs(cosines[1] + std::sin(1.2) / 3) < 1e-14, "another cosine");

    // A parallelogram: its coupler does not turn, so a point of it moves as the crank's end.
    const Complex drawn[5] = {{0, 0}, {0, 1}, {2, 1}, {2, 0}, {1, 3}};
    const CrankDyad dyad{Form::rrr, {2, 3}, {1, 0}, {1, 3}, {1, 3}, {2, 2}};
    all = {{0, 1, 0, 0}, &dyad, 1, 4, 5, 1, drawn, nullptr, &side, angles, 2, lanes};
    Complex z[2], slopes[22];
    expect(trace_slopes(all, 2, true, z, slopes, watch), "it is interrupted");
    expect(std::abs(z[0].x - (1 - std::sin(0.3))) < 1e-14 && std::abs(z[0].y - (2 + std::cos(0.3))) < 1e-14, "another point");
    expect(std::abs(slopes[20].x + std::cos(0.3)) < 1e-14 && std::abs(slopes[20].y + std::sin(0.3)) < 1e-14, "another slope");
    double tops[2], changes[20];
    expect(find_tops(all, watched, true, tops, watch) && cosine_slopes(all, watched, changes, watch), "it is interrupted");

    CrankDyad wrong = dyad;
    wrong.bases[0] = 2;
    all.dyads = &wrong;
    expect(!fault(all).empty(), "a dyad hangs on itself");

    // Rods of length 1 on a base of length 1: an equilateral triangle.
    const ClosedJoint joints[3] = {{{2, 0}, {0, 2}, 0}, {{0, 1}, {4, 6}, 0}, {{2, 1}, {8, 10}, 0}};
    const double p[12] = {0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0}, q[6] = {0, 0, 0.9, 0, 1, -1};
    Closing closing{joints, 3, 2, 12, 1, q, p, 1};
    expect(fault(closing).empty(), "rods are refused");
    double closed[6], motion[6], gradients[24];
    std::uint8_t reached;
    expect(close_poses(closing, 20, closed, &reached, watch) && reached, "rods do not meet");
    expect(std::abs(closed[2] - std::acos(0.5)) < 1e-12, "another triangle");
    const double by_pose[12] = {0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    closing.q = closed;
    expect(move_poses(closing, motion, watch) && pose_gradients(closing, 2, by_pose, gradients, watch), "it is interrupted");
    // A base longer by s takes the first rod down by s / (2 sin 60 degrees).
    expect(std::abs(gradients[8] + 1 / std::sqrt(3.0)) < 1e-12, "another slope");
    const ClosedJoint beyond[1] = {{{2, 0}, {0, 11}, 0}};
    expect(!fault({beyond, 1, 2, 12, 1, q, p, 1}).empty(), "a joint lies beyond all dimensions");

    // The x axis, and a target 1 above 0.7: 1.25 away at 0.7 + 0.75.
    const double arcs[3] = {0, 1, 2}, low = 0.7, high = 2, start = 1.9, level = 1.25 * 1.25 / 2;
    const Complex axis[3] = {{0, 0}, {1, 0}, {2, 0}}, ahead[3] = {{1, 0}, {1, 0}, {1, 0}}, target{0.7, 1};
    const std::int64_t first = 0;
    double at, spread[4];
    const Brackets bracket{&target, &first, &low, &high, &start, &level, 1, 1};
    expect(settle_arcs({arcs, axis, ahead, 3, 1, false}, bracket, &at, watch) && std::abs(at - 1.45) < 1e-12, "another place");
    const Complex square[5] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    const double corners[5] = {0, 1, 2, 3, 4};
    expect(spread_evenly(square, corners, 1, 5, 4, spread, watch) && std::abs(spread[3] - 3) < 1e-14, "other places");

    // x and y may not be positive.
    const double gram[4] = {2, 0.5, 0.5, 1}, step[2] = {1, 2}, values[2] = {0, 0}, normals[4] = {1, 0, 0, 1};
    double moved[2];
    expect(limit_steps({1, 2, 2, 2, gram, step, values, normals, 1e-9}, moved, &reached, watch) && reached, "it is inside");
    expect(std::abs(moved[0]) < 1e-12 && std::abs(moved[1]) < 1e-12, "another corner");
    std::puts("design: all as it should be");
}
