// Linkages of a crank and dyads without Python, for sanitizers: a slider-crank by its closed form, a parallelogram, refusals.
#include <cmath>
#include <cstdio>
#include <vector>

#include "check.hpp"
#include "design/crank_dyads.hpp"

using namespace gruebler;
using namespace gruebler::design;

int main() {
    Watch watch{always, nullptr};
    const double side = 1, angles[2] = {0.3, 1.2};
    const std::vector<std::int64_t> watched{0};
    // The crank of 1, the rod of 3, the guide along the x axis; elements are those of each joint in turn.
    const Complex own[8] = {{0, 0}, {0, 0}, {1, 0}, {0, 0}, {3, 0}, {0, 0}, {0, 0}, {0, 0}};
    const std::vector<Complex> lines(8, Complex{1, 0});
    const CrankDyad slider{Form::rrp, {2, 3}, {1, 0}, {2, 6}, {3, 7}, {4, 5}};
    Linkages all{{0, 1, 0, 1}, &slider, 1, 4, 8, 1, own, lines.data(), &side, angles, 2};
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
    all = {{0, 1, 0, 0}, &dyad, 1, 4, 5, 1, drawn, nullptr, &side, angles, 2};
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
    std::puts("design: all as it should be");
}
