// The algebra without Python, for sanitizers: a four-bar through nine points that is known, followed to another task and
// back; numbers that are none.
#include <cmath>
#include <complex>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "algebra/certificate.hpp"
#include "algebra/tracking.hpp"
#include "check.hpp"

using namespace gruebler;
using namespace gruebler::algebra;
using Number = std::complex<double>;

namespace {

const double* parts(const std::vector<Number>& numbers) { return reinterpret_cast<const double*>(numbers.data()); }
double* parts(std::vector<Number>& numbers) { return reinterpret_cast<double*>(numbers.data()); }

struct Known {
    std::vector<Number> z = std::vector<Number>(8), task = std::vector<Number>(32);
};

// Linkage and turns are chosen; a displacement that fits both dyads is the root of a quadratic.
Known known_solution(unsigned seed, int positions, int points) {
    std::mt19937 bits(seed);
    std::normal_distribution<double> normal;
    const auto random = [&] { return Number(normal(bits), normal(bits)); };
    Known known;
    for (Number& u : known.z) u = random();
    const auto& z = known.z;
    const Number x = z[0], xc = z[1], y = z[2], yc = z[3], a = z[4], ac = z[5], b = z[6], bc = z[7];
    for (int j = 0; j < positions + points; ++j) {
        const Number g = random(), h = -g / (1. + g);
        // Each dyad: t k + s l - t s + m = 0.
        const Number k1 = ac - xc - xc * h, l1 = a - x - x * g, m1 = ac * x * g + a * xc * h;
        const Number k2 = bc - yc - yc * h, l2 = b - y - y * g, m2 = bc * y * g + b * yc * h;
        const Number slope = -(k1 - k2) / (l1 - l2), rest = -(m1 - m2) / (l1 - l2);
        const Number half = (k1 + slope * l1 - rest) / (2. * slope);
        known.task[j] = half + std::sqrt(half * half + (rest * l1 + m1) / slope);
        known.task[8 + j] = slope * known.task[j] + rest;
        if (j < positions) known.task[16 + j] = g;
    }
    for (int r = 2 * positions + points; r < 8; ++r) known.task[24 + r] = z[r];
    return known;
}

struct Followed {
    std::vector<Number> ends;
    PathEnd end;
    std::int64_t steps;
    bool done;
};

Followed follow(const std::vector<Number>& starts, const std::vector<Number>& begin, const std::vector<Number>& end,
                int positions, int points, bool (*goes_on)(void*) = always) {
    Followed out{std::vector<Number>(8), PathEnd::failed, 0, false};
    std::int64_t status = 1;
    Watch watch{goes_on, nullptr, 1};
    out.done = baseline::track({Family::four_bars, positions, points, 1, parts(starts), parts(begin), parts(end), 1e-3,
                                parts(out.ends), &status, &out.steps}, watch);
    out.end = static_cast<PathEnd>(status);
    return out;
}

bool proved(const std::vector<Number>& z, const std::vector<Number>& task, int positions, int points) {
    std::uint8_t answer = 0;
    Watch watch{always, nullptr};
    expect(certify({positions, points, 1, parts(task), parts(z), &answer}, watch), "a proof did not end");
    return answer != 0;
}

}  // namespace

int main() {
    const int shapes[][2] = {{0, 8}, {1, 6}, {2, 4}, {3, 2}, {0, 4}};
    for (const auto& [positions, points] : shapes) {
        const Known here = known_solution(1, positions, points), there = known_solution(2, positions, points);
        expect(proved(here.z, here.task, positions, points), "a known solution was not proved");
        std::vector<Number> wrong = here.z;
        wrong[0] += 0.1;
        expect(!proved(wrong, here.task, positions, points), "what is no solution was proved");
        const Followed away = follow(here.z, here.task, there.task, positions, points);
        expect(away.done && away.end == PathEnd::arrived, "a path did not arrive");
        expect(proved(away.ends, there.task, positions, points), "an end was not proved");
        const Followed back = follow(away.ends, there.task, here.task, positions, points);
        for (int i = 0; i < 8; ++i) expect(std::abs(back.ends[i] - here.z[i]) < 1e-8, "a path did not come back");
        expect(!follow(here.z, here.task, there.task, positions, points, never).done, "a watch did not end a path");
    }
    const Known known = known_solution(3, 0, 8);
    for (const double odd : {0.0, 1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        const std::vector<Number> starts(8, odd), task(32, odd);
        for (const auto& end : {known.task, task}) {
            const Followed nowhere = follow(starts, known.task, end, 0, 8);
            expect(nowhere.done && nowhere.end != PathEnd::arrived, "numbers that are none led somewhere");
        }
        expect(!proved(starts, task, 2, 4), "numbers that are none were proved");
    }
    std::puts("algebra: all as it should be");
}
