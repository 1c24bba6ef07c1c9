// Free motion without Python, for sanitizers: an oscillator whose mass and stiffness are short series.
#include <cmath>
#include <cstdio>
#include <limits>

#include "check.hpp"
#include "dynamics/series.hpp"

using namespace gruebler::dynamics;

int main() {
    const double none = std::numeric_limits<double>::quiet_NaN();
    // M = 2, Q = -8 q on [-1, 1]: q'' = -4 q. No slope, no damping.
    const Piece piece{-1, 1, 0, 1};
    const double coefficients[2 * quantities] = {2, 0, 0, 0, 0, 0, 0, 0, -8, 0, 0, 0};
    const Series series{1, 2, &piece, coefficients, none};
    Reduced reduced;
    expect(reduce(series, 0.5, 3, reduced) && reduced.mass == 2 && reduced.force == -4, "another force");
    expect(!reduce(series, 1.5, 0, reduced) && !reduce(series, none, 0, reduced), "a piece is used beyond its end");
    const Series turning{1, 2, &piece, coefficients, -1};
    const bool back = reduce(turning, 0.5 + 2 * std::acos(-1.0), 3, reduced);
    expect(back && std::abs(reduced.force + 4) < 1e-14, "no turn back");

    // Euler's method with a wished error: one stage counts, so the step is as long as it likes.
    double a[stages * stages] = {}, b[stages] = {1}, e[stages + 1] = {};
    double further[further_stages * all_stages] = {}, bend[bends * all_stages] = {};
    const Method method{a, b, e, e, further, bend};
    Step taken;
    const Ended ended = step(series, method, 0, {0.5, 0, 0}, {0, -2, 0}, 0.1, 1, 1e-9, {1e-9, 1e-9, 1e-9}, taken);
    expect(ended == Ended::stepped && std::abs(taken.state[1] + 0.2) < 1e-15, "another step");
    expect(step(series, method, 0, {0.9, 9, 0}, {9, -2, 0}, 0.5, 1, 1e-9, {1e-9, 1e-9, 1e-9}, taken) == Ended::outside,
           "a step leaves its piece");

    // Many such steps, each at most the rest of the time; the stop lies in the first one, on the polynomial of its ends.
    const std::uint8_t calm[] = {1}, wild[] = {0};
    const double stop[] = {0.05, 0.7};
    for (const std::uint8_t* flags : {calm, wild}) {
        Run run{0, 0.1, {0.5, 0, 0}, {0, -2, 0}};
        int steps = 0, stops = 0;
        advance(
            series, method, flags, run, 0.15, 1e-9, {1e-9, 1e-9, 1e-9}, 9, stop, stop + 2,
            [&](const Run&, std::int64_t) { ++steps; }, [&](const State& at) { stops += std::abs(at[1] + 0.1) < 1e-15; });
        expect(stops == 1 && steps == (flags == calm ? 2 : 1), "another run of steps");
        expect(run.time == (flags == calm ? 0.15 : 0.1), "a run ends elsewhere");
    }
    std::puts("dynamics: all as it should be");
}
