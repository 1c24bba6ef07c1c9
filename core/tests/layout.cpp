// Layouts without Python, for sanitizers: a square of bars, a point beside a bar, two bars that cross.
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "check.hpp"
#include "layout/relaxation.hpp"

using namespace gruebler;
using namespace gruebler::layout;

int main() {
    Watch watch{always, nullptr};
    const std::vector<Segment> sides{{0, 1}, {1, 2}, {2, 3}, {3, 0}}, diagonals{{0, 2}, {1, 3}};
    const std::vector<double> pull(4, 1);
    std::vector<Watched> watched;
    for (std::int64_t s = 0; s < 4; ++s)
        for (std::int64_t p = 0; p < 4; ++p)
            if (p != sides[s].start && p != sides[s].end) watched.push_back({s, p});
    // The quarter turns of the square.
    std::vector<std::int64_t> images;
    std::vector<Turn> turns;
    for (int g = 0; g < 4; ++g) {
        for (int p = 0; p < 4; ++p) images.push_back((p + g) % 4);
        const double c = g == 0 ? 1 : g == 2 ? -1 : 0, s = g == 1 ? 1 : g == 3 ? -1 : 0;
        turns.push_back({c, -s, s, c});
    }
    Drawing square{4, 4, 8, sides.data(), pull.data(), watched.data(), 4, images.data(), turns.data()};
    std::vector<Point> layout{{0.3, 0.1}, {0, 0.4}, {-0.2, 0}, {0, -0.3}};
    const Relaxed relaxed = relax(square, 2, 500, layout.data(), watch);
    // Of side a the energy is 4 a^2 + 8 / a^2: least at a^4 = 2.
    expect(relaxed.done && std::abs(relaxed.energy - 2 * std::sqrt(32.0)) < 1e-5, "the square has another energy");
    expect(std::abs(closest(square, layout.data()) - std::pow(2, 0.25)) < 1e-3, "the square has another side");

    std::vector<Segment> pairs;
    Drawing crossed{4, 2, 0, diagonals.data(), nullptr, nullptr, 0, nullptr, nullptr};
    expect(crossing_segments(crossed, layout.data(), pairs, watch) && pairs.size() == 1, "diagonals cross");
    expect(std::isinf(closest(crossed, layout.data())), "nothing is watched");

    for (const double odd : {0.0, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
        std::vector<Point> anywhere(4, {odd, odd});
        expect(relax(square, 6, 50, anywhere.data(), watch).done, "numbers that are none did not end");
    }
    std::puts("layout: all as it should be");
}
