#include "motion/tracing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "motion/inverses.hpp"
#include "motion/newton.hpp"

namespace gruebler::motion {
namespace {

constexpr double dependent = 1e-7;  // a row shorter than this, after what it shares with others is taken away, depends on them
constexpr double shortest = 1e-10;  // the shortest step
constexpr double away = 1e-6;       // no sample is taken where an independent row is shorter
constexpr double open_most = 1e-11;  // a sample is open by less
constexpr double bend_least = 0.98;  // the least cosine between the tangents of neighbouring samples
constexpr double skew_most = 0.02;   // chord and mean tangent of a step differ by less
constexpr double same = 1e-8;        // the curve is closed when it comes back as near as that
constexpr int corrections = 12;      // Newton's method arrives in 3 to 5; a row that is nearly dependent takes some more
constexpr double torn = 1e3;         // sizes: a residual that large comes of a pose that is lost
constexpr double astray = 1;         // squared length of a step, in sizes and radians: it leads away from the curve
constexpr double arrived = 1e-16;    // squared length of a step: the next would be below rounding
constexpr double no_tangent = 1e-6;  // a direction of length 1 that keeps less in the null space has no part of it but rounding
constexpr double start_steps = 1.2;  // the start is looked for a little farther than one step ahead
constexpr double start_aside = 0.04;    // squared, of the way to the start: how far it may lie aside of the tangent, 0.2
constexpr double before_start = 0.999;  // of the way to the start: from there Newton's method has to arrive at it
constexpr double straight = 1e-6;       // half the difference of tangents: asin(x) = x below
constexpr double shorter = 0.6, longer = 1.5;  // the next step after one that failed, and after one that did not

double dot(const double* a, const double* b, int n) {
    double sum = 0;
    for (int k = 0; k < n; ++k) sum += a[k] * b[k];
    return sum;
}

void subtract(double* row, double share, const double* other, int n) {
    for (int k = 0; k < n; ++k) row[k] -= share * other[k];
}

int all_equations(const Conditions& conditions) {
    int m = 0;
    for (int c = 0; c < conditions.count; ++c) m += equations(conditions.list[c].kind);
    return m;
}

}  // namespace

Tracing::Tracing(const Conditions& conditions, int unknowns)
    : conditions_(conditions), n_(unknowns), m_(all_equations(conditions)) {
    const std::size_t rows = std::max(m_ + 1, n_), n = n_;
    for (std::vector<double>* one : {&rows_, &work_, &shares_}) one->resize(rows * n);
    for (std::vector<double>* one : {&residual_, &lengths_}) one->resize(rows);
    for (std::vector<double>* one : {&trial_, &normal_}) one->resize(n);
    basis_.resize(n * n);
    order_.resize(rows);
    free_.resize(rows);
}

// Orthonormalises the rows, the longest remaining one first, after `first` if that is not -1; returns the rank.
//
// row order[j] = sum of shares[order[j], i] basis[i] over i <= j.
int Tracing::reduce(int count, int first) {
    ++reduced_;
    const int n = n_;
    std::copy(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(count) * n, work_.begin());
    std::fill(free_.begin(), free_.begin() + count, char{1});
    double *work = work_.data(), *basis = basis_.data(), *shares = shares_.data();
    for (int i = 0; i < count; ++i) lengths_[i] = dot(work + i * n, work + i * n, n);
    const int most = std::min(count, n);
    for (int j = 0; j < most; ++j) {
        int best = -1;
        double longest = dependent * dependent;
        for (int i = 0; i < count; ++i)
            if (free_[i] && (j > 0 || first < 0 || i == first) && lengths_[i] > longest) best = i, longest = lengths_[i];
        if (best < 0) return j;
        free_[best] = 0;
        order_[j] = best;
        double *row = work + best * n, *next = basis + j * n;
        for (int i = 0; i < j; ++i) {  // a second time: rows that are nearly dependent have lost digits
            const double share = dot(row, basis + i * n, n);
            shares[best * n + i] += share;
            subtract(row, share, basis + i * n, n);
        }
        const double length = std::sqrt(dot(row, row, n));
        shares[best * n + j] = length;
        for (int k = 0; k < n; ++k) next[k] = row[k] / length;
        for (int i = 0; i < count; ++i) {
            if (!free_[i]) continue;
            double* other = work + i * n;
            const double share = dot(other, next, n);
            shares[i * n + j] = share;
            if (share == 0) continue;
            subtract(other, share, next, n);
            lengths_[i] = dot(other, other, n);
        }
    }
    return most;
}

// Newton's method in place: onto the curve by shortest steps, or in the plane normal * x = level.
bool Tracing::correct(double* x, const double* normal, double level) {
    const int n = n_;
    for (int step = 0; step < corrections; ++step) {
        const double miss = closing(conditions_, x, n, residual_.data(), rows_.data());
        if (!(miss < torn)) return false;
        int count = m_;
        if (normal) {
            count = m_ + 1;
            double sum = -level;
            for (int k = 0; k < n; ++k) {
                rows_[m_ * n + k] = normal[k];
                sum += normal[k] * x[k];
            }
            residual_[m_] = sum;
        }
        const int rank = reduce(count, normal ? m_ : -1);
        double moved = 0;
        for (int j = 0; j < rank; ++j) {
            const int row = order_[j];
            double share = residual_[row];
            for (int i = 0; i < j; ++i) share -= shares_[row * n + i] * residual_[order_[i]];
            share /= shares_[row * n + j];
            residual_[row] = share;
            moved += share * share;
            subtract(x, share, basis_.data() + j * n, n);
        }
        if (!(moved < astray)) return false;
        if (moved < arrived) return true;
    }
    return false;
}

// Turns a direction into the tangent: its part in the null space of the Jacobian, of length 1.
Tracing::Tangent Tracing::set_tangent(const double* x, double* tangent) {
    const int n = n_;
    const double miss = closing(conditions_, x, n, residual_.data(), rows_.data());
    const int rank = reduce(m_, -1);
    for (int time = 0; time < 2; ++time) {
        for (int j = 0; j < rank; ++j) {
            const double* row = basis_.data() + j * n;
            subtract(tangent, dot(tangent, row, n), row, n);
        }
    }
    const double length = std::sqrt(dot(tangent, tangent, n));
    if (!(length > no_tangent) || rank == 0) return {std::numeric_limits<double>::infinity(), 0, rank};
    for (int k = 0; k < n; ++k) tangent[k] /= length;
    double gauge = shares_[order_[rank - 1] * n + rank - 1];
    if (m_ == n - 1) {
        std::copy(tangent, tangent + n, rows_.begin() + static_cast<std::ptrdiff_t>(m_) * n);
        if (factor(rows_.data(), n, order_.data()) < 0) gauge = -gauge;
    }
    return {miss, gauge, rank};
}

Settled Tracing::settle(double* x, double* tangent) {
    const bool arrived_there = correct(x, nullptr, 0);
    const Tangent there = set_tangent(x, tangent);
    return {arrived_there, there.open, there.gauge, there.rank};
}

// Whether the start lies one step ahead of sample k; writes it, turned on by whole turns, into the normal.
bool Tracing::start_ahead(const Samples& samples, std::int64_t k, double step) {
    constexpr double turn_round = 2 * std::numbers::pi;
    const double *here = samples.poses + k * n_, *tangent = samples.tangents + k * n_;
    double along = 0, alike = 0;
    for (int i = 0; i < n_; ++i) {
        double gap = samples.poses[i] - here[i];
        if (i % 3 == 2) gap -= turn_round * std::floor(gap / turn_round + 0.5);
        normal_[i] = gap;
        along += gap * tangent[i];
        alike += samples.tangents[i] * tangent[i];
    }
    if (!(0 < along && along <= start_steps * step && alike > bend_least)) return false;
    double aside = 0;
    for (int i = 0; i < n_; ++i) {
        const double off = normal_[i] - along * tangent[i];
        aside += off * off;
        normal_[i] += here[i];
    }
    return aside < start_aside * along * along;
}

// Writes sample k + 1, one step on or at the start.
Tracing::Attempt Tracing::attempt(const Samples& samples, std::int64_t k, double step) {
    const int n = n_;
    const std::int64_t past_k = std::max<std::int64_t>(k - 1, 0);
    const double *before = samples.poses + past_k * n, *here = samples.poses + k * n;
    const double *old = samples.tangents + past_k * n, *tangent = samples.tangents + k * n;
    double *after = samples.poses + (k + 1) * n, *next = samples.tangents + (k + 1) * n;
    double level = 0, past = 0;
    for (int i = 0; i < n; ++i) past += square(here[i] - before[i]);
    const double bend = k == 0 ? 0.0 : step * step / 2 / std::sqrt(past);
    for (int i = 0; i < n; ++i) {
        trial_[i] = here[i] + step * tangent[i] + bend * (tangent[i] - old[i]);
        level += tangent[i] * trial_[i];
    }
    bool back = start_ahead(samples, k, step);
    if (back) {
        level = 0;
        for (int i = 0; i < n; ++i) {
            after[i] = normal_[i];
            level += samples.tangents[i] * after[i];
            trial_[i] = here[i] + (after[i] - here[i]) * before_start;
        }
        back = correct(trial_.data(), samples.tangents, level);
        for (int i = 0; i < n; ++i) back = back && std::fabs(trial_[i] - after[i]) < same;
    }
    if (!back && !correct(trial_.data(), tangent, level)) return {false, false};
    for (int i = 0; i < n; ++i) {
        if (!back) after[i] = trial_[i];
        next[i] = back ? samples.tangents[i] : tangent[i];
    }
    const Tangent there = set_tangent(after, next);
    samples.gauges[k + 1] = there.gauge;
    if (!(there.open < open_most && there.rank == n - 1 && std::fabs(there.gauge) > away)) return {false, false};
    double cosine = 0, chord = 0, mean = 0, skew = 0, turned = 0;
    for (int i = 0; i < n; ++i) {
        cosine += next[i] * tangent[i];
        chord += square(after[i] - here[i]);
        mean += square(next[i] + tangent[i]);
        turned += square(next[i] - tangent[i]);
    }
    chord = std::sqrt(chord);
    mean = std::sqrt(mean);
    for (int i = 0; i < n; ++i) skew += square((after[i] - here[i]) / chord - (next[i] + tangent[i]) / mean);
    if (!(cosine > bend_least && skew < skew_most * skew_most && chord < 2 * step)) return {false, false};
    const double half = std::sqrt(turned) / 2;
    const double angle = direction_angle({std::sqrt(1 - half * half), half});
    samples.arcs[k + 1] = samples.arcs[k] + chord * (half > straight ? angle / half : 1.0);
    return {true, back};
}

// An orthonormalisation takes about m n^2 operations.
bool Tracing::go_on(Watch& watch) {
    const std::int64_t cost = reduced_ * (m_ + 1) * n_ * n_;
    reduced_ = 0;
    return spend(watch, cost);
}

Trace Tracing::follow(const Samples& samples, std::int64_t count, double step, double longest, double most,
                      Watch& watch) {
    while (true) {
        const std::int64_t k = count - 1;
        if (count == samples.room) return {TraceEnd::full, count, step};
        if (samples.arcs[k] >= most) return {TraceEnd::too_long, count, step};
        const Attempt attempted = attempt(samples, k, step);
        if (!go_on(watch)) return {TraceEnd::interrupted, count, step};
        if (!attempted.good) {
            step *= shorter;
            if (!(step >= shortest)) return {TraceEnd::lost, count, step};
            continue;
        }
        if (samples.gauges[k] * samples.gauges[k + 1] < 0) return {TraceEnd::flip, count, step};
        ++count;
        if (attempted.back) return {TraceEnd::closed, count, step};
        step = smaller(longer * step, longest);
    }
}

std::int64_t Tracing::evaluate(const Samples& samples, const double* at, const std::int64_t* segments,
                               std::int64_t count, double* poses, double* tangents, Watch& watch) {
    const int n = n_;
    for (std::int64_t row = 0; row < count; ++row) {
        const std::int64_t k = segments[row];
        const double extent = samples.arcs[k + 1] - samples.arcs[k], u = (at[row] - samples.arcs[k]) / extent;
        double *pose = poses + row * n, *tangent = tangents + row * n;
        double chord = 0, level = 0;
        for (int i = 0; i < n; ++i) {
            const double start = samples.poses[k * n + i], end = samples.poses[(k + 1) * n + i];
            const double leave = extent * samples.tangents[k * n + i], arrive = extent * samples.tangents[(k + 1) * n + i];
            const double change = end - start;
            const double bent = 3 * change - 2 * leave - arrive, skewed = leave + arrive - 2 * change;
            pose[i] = start + u * (leave + u * (bent + u * skewed));
            tangent[i] = (leave + u * (2 * bent + 3 * u * skewed)) / extent;
            normal_[i] = change;
            chord += change * change;
        }
        chord = std::sqrt(chord);
        for (int i = 0; i < n; ++i) {
            normal_[i] /= chord;
            level += normal_[i] * pose[i];
        }
        if (!correct(pose, normal_.data(), level)) return row;
        if (!(set_tangent(pose, tangent).open < open_most)) return row;
        if (!go_on(watch)) return row;
    }
    return count;
}

}  // namespace gruebler::motion
