#include "dynamics/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gruebler::dynamics {
namespace {

constexpr double turn = 6.283185307179586;
// Those of scipy, for equal steps.
constexpr double safety = 0.9, least_factor = 0.2, largest_factor = 10;  // of the next step
constexpr double shortest = 10;  // in distances between times that can be told apart
constexpr double weight_of_third = 0.01;  // the estimate of order 3 beside that of order 5

bool rate_of(const Series& series, const State& state, State& rate) {
    Reduced reduced;
    if (!reduce(series, state[0], state[1], reduced)) return false;
    rate = {state[1], reduced.force / reduced.mass, reduced.power * state[1]};
    return true;
}

// state + length sum of weight rate
State moved(const State& state, double length, const double* weight, const State* rates, int count) {
    State sum{}, next;
    for (int s = 0; s < count; ++s)
        for (int k = 0; k < width; ++k) sum[k] += weight[s] * rates[s][k];
    for (int k = 0; k < width; ++k) next[k] = state[k] + length * sum[k];
    return next;
}

double squared(const double* weight, const State* rates, const State& scale) {
    double sum = 0;
    for (int k = 0; k < width; ++k) {
        double part = 0;
        for (int s = 0; s <= stages; ++s) part += weight[s] * rates[s][k];
        sum += part / scale[k] * (part / scale[k]);
    }
    return sum;
}

// Of order 7: the fifth and third order beside the eighth. Not below 1 if it is not a number.
double error_of(const Method& method, const Step& taken, const State& scale) {
    const double fifth = squared(method.e5, taken.rates.data(), scale);
    const double third = squared(method.e3, taken.rates.data(), scale);
    if (fifth == 0 && third == 0) return 0;
    return taken.length * fifth / std::sqrt((fifth + weight_of_third * third) * width);
}

double eighth_root(double x) { return std::sqrt(std::sqrt(std::sqrt(x))); }

}  // namespace

std::int64_t piece_at(const Series& series, double& q) {
    if (!std::isfinite(q)) return -1;
    if (!std::isnan(series.closed)) q -= turn * std::floor((q - series.closed) / turn);
    const Piece* end = series.piece + series.pieces;
    const Piece* piece = std::lower_bound(series.piece, end, q, [](const Piece& p, double at) { return p.high < at; });
    return piece == end || !(piece->low <= q) ? -1 : piece - series.piece;
}

bool reduce(const Series& series, double q, double speed, Reduced& reduced) {
    const std::int64_t number = piece_at(series, q);
    if (number < 0) return false;
    const Piece& piece = series.piece[number];
    const double x = std::clamp((q - piece.middle) / piece.half, -1.0, 1.0);
    // Clenshaw's recurrence, for all quantities side by side.
    const double* coefficient = series.coefficient + number * series.orders * quantities;
    double above[quantities] = {}, further[quantities] = {};
    for (std::int64_t order = series.orders - 1; order > 0; --order)
        for (int k = 0; k < quantities; ++k) {
            const double here = coefficient[order * quantities + k] + 2 * x * above[k] - further[k];
            further[k] = above[k];
            above[k] = here;
        }
    double value[quantities];
    for (int k = 0; k < quantities; ++k) value[k] = coefficient[k] + x * above[k] - further[k];
    const auto [mass, slope, force, damped, lost, lost_by_speed] = value;
    reduced = {mass, force + speed * (damped - speed * slope), lost + speed * lost_by_speed};
    return true;
}

Ended step(const Series& series, const Method& method, double time, const State& state, const State& rate,
           double length, double until, double relative, const State& absolute, Step& taken) {
    const double least = shortest * (std::nextafter(time, std::numeric_limits<double>::infinity()) - time);
    taken.evaluations = 0;
    taken.rates[0] = rate;
    length = std::max(length, least);
    for (bool rejected = false;; rejected = true) {
        if (!(length >= least)) return Ended::too_small;
        taken.time = std::min(time + length, until);
        taken.length = length = taken.time - time;
        for (int s = 1; s < stages; ++s) {
            const State at = moved(state, length, method.a + s * stages, taken.rates.data(), s);
            if (!rate_of(series, at, taken.rates[s])) return Ended::outside;
        }
        taken.state = moved(state, length, method.b, taken.rates.data(), stages);
        if (!rate_of(series, taken.state, taken.rates[stages])) return Ended::outside;
        taken.evaluations += stages;
        State scale;
        for (int k = 0; k < width; ++k)
            scale[k] = absolute[k] + std::max(std::abs(state[k]), std::abs(taken.state[k])) * relative;
        const double error = error_of(method, taken, scale), factor = safety / eighth_root(error);
        if (error < 1) {
            taken.next = length * std::min(factor, rejected ? 1.0 : largest_factor);
            return Ended::stepped;
        }
        length *= factor > least_factor ? factor : least_factor;  // also if it is not a number
    }
}

bool bent(const Series& series, const Method& method, const State& state, Step& taken, Bend& bend) {
    const double length = taken.length;
    State* rates = taken.rates.data();
    for (int s = stages + 1; s < all_stages; ++s) {
        const double* weight = method.further + (s - stages - 1) * all_stages;
        if (!rate_of(series, moved(state, length, weight, rates, s), rates[s])) return false;
    }
    taken.evaluations += further_stages;
    for (int k = 0; k < width; ++k) {
        const double way = taken.state[k] - state[k];
        bend[0][k] = way;
        bend[1][k] = length * rates[0][k] - way;
        bend[2][k] = 2 * way - length * (rates[0][k] + rates[stages][k]);
    }
    for (int n = 0; n < bends; ++n) bend[3 + n] = moved({}, length, method.bend + n * all_stages, rates, all_stages);
    return true;
}

State within(const Bend& bend, const State& state, double part) {
    State value{};
    for (std::size_t n = bend.size(); n-- > 0;)
        for (int k = 0; k < width; ++k) value[k] = (value[k] + bend[n][k]) * (n % 2 ? 1 - part : part);
    for (int k = 0; k < width; ++k) value[k] += state[k];
    return value;
}

}  // namespace gruebler::dynamics
