#include "design/sampled_curves.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gruebler::design {
namespace {

using namespace motion;

constexpr int tries = 100;      // halvings alone take about 50
constexpr double still = 1e-13;

struct Distance {
    double square, slope, bend;  // half the squared distance with two derivatives by the arc
};

Distance distance(const SmoothCurve& curve, const Complex* target, double arc) {
    const double length = curve.arcs[curve.samples - 1];
    double place = arc;
    if (curve.closed) {
        place = std::fmod(arc, length);
        if (place < 0) place += length;
    } else {
        place = std::min(std::max(arc, 0.0), length);
    }
    const auto above = std::upper_bound(curve.arcs, curve.arcs + curve.samples, place) - curve.arcs;
    const auto row = std::clamp<std::int64_t>(above - 1, 0, curve.samples - 2);
    const double h = curve.arcs[row + 1] - curve.arcs[row], t = (place - curve.arcs[row]) / h;
    Distance sum{0, 0, 0};
    for (std::int64_t k = 0; k < curve.parts; ++k) {
        if (std::isnan(target[k].x) || std::isnan(target[k].y)) continue;
        const Complex* value = curve.values + row * curve.parts + k;
        const Complex* rate = curve.rates + row * curve.parts + k;
        const Complex first = h * rate[0], second = h * rate[curve.parts], gap = value[curve.parts] - value[0];
        const Complex squared = 3 * gap - 2 * first - second, cubed = first + second - 2 * gap;
        const Complex off = value[0] + t * (first + t * (squared + t * cubed)) - target[k];
        const Complex speed = (first + t * (2 * squared + 3 * t * cubed)) / h;
        const Complex bend = (2 * squared + 6 * t * cubed) / (h * h);
        sum.square += dot(off, off) / 2;
        sum.slope += dot(off, speed);
        sum.bend += dot(speed, speed) + dot(off, bend);
    }
    return sum;
}

}  // namespace

bool settle_arcs(const SmoothCurve& curve, const Brackets& brackets, double* arcs, Watch& watch) {
    for (std::int64_t n = 0; n < brackets.count; ++n) {
        double low = brackets.low[n], high = brackets.high[n], at = brackets.start[n];
        const Complex* target = brackets.targets + brackets.target[n] * curve.parts;
        for (int k = 0; k < tries && high > low; ++k) {
            const Distance here = distance(curve, target, at);
            const double value = brackets.levels ? here.square - brackets.levels[n] : here.slope;
            const double slope = brackets.levels ? here.slope : here.bend;
            (value * brackets.rises < 0 ? low : high) = at;
            const double step = at - value / slope;
            const double moved = step >= low && step <= high ? step : (low + high) / 2;
            const double change = std::fabs(moved - at);
            at = moved;
            if (!(change > still * (1 + std::fabs(moved)))) break;
        }
        arcs[n] = at;
        if (!spend(watch, 20 * curve.parts)) return false;
    }
    return true;
}

bool spread_evenly(const Complex* z, const double* parameters, std::int64_t curves, std::int64_t samples, std::int64_t places,
                   double* spread, Watch& watch) {
    std::vector<double> arcs(samples);
    for (std::int64_t n = 0; n < curves; ++n) {
        const Complex* own = z + n * samples;
        for (std::int64_t k = 1; k < samples; ++k) {
            const Complex gap = own[k] - own[k - 1];
            arcs[k] = arcs[k - 1] + std::sqrt(dot(gap, gap));
        }
        std::int64_t row = 0;
        for (std::int64_t k = 0; k < places; ++k) {
            const double wanted = static_cast<double>(k) / static_cast<double>(places) * arcs[samples - 1];
            while (row < samples - 2 && arcs[row + 1] <= wanted) ++row;
            const double gap = arcs[row + 1] - arcs[row], step = parameters[row + 1] - parameters[row];
            spread[n * places + k] = parameters[row] + (gap > 0 ? step * ((wanted - arcs[row]) / gap) : 0);
        }
        if (!spend(watch, 2 * (samples + places))) return false;
    }
    return true;
}

}  // namespace gruebler::design
