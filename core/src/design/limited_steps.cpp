#include "design/limited_steps.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gruebler::design {
namespace {

constexpr double dependent = 1e-13;  // a column that others span, all of length 1
constexpr double settled = 1e-14;    // a gradient that counts as zero, of columns of length 1
constexpr double nowhere = 1e-12;    // the rest if there is no point within all limits

double product(const double* a, const double* b, std::int64_t count) {
    double sum = 0;
    for (std::int64_t i = 0; i < count; ++i) sum += a[i] * b[i];
    return sum;
}

// Least squares |E u - f| with u not negative, f the last unit vector; columns one after the other, of length 1 or 0.
class PositiveLeastSquares {
public:
    PositiveLeastSquares(std::int64_t rows, std::int64_t columns)
        : rows_(rows), columns_(columns), u_(columns), trial_(columns), rest_(rows), factors_(rows * columns), diagonal_(columns),
          shares_(columns), tried_(columns) {}

    // E u - f in `rest`; false if it takes too many steps.
    bool solve(const double* matrix) {
        matrix_ = matrix;
        std::fill(u_.begin(), u_.end(), 0.0);
        passive_.clear();
        find_rest();
        for (std::int64_t round = 0; round < 3 * columns_ + 10; ++round) {
            std::fill(tried_.begin(), tried_.end(), false);
            std::int64_t next = choose();
            while (next >= 0) {
                passive_.push_back(next);
                if (fit() && trial_[next] > 0) break;
                passive_.pop_back();
                tried_[next] = true;
                next = choose();
            }
            if (next < 0) return true;
            while (!step_to_trial())
                if (!fit()) return false;
            find_rest();
        }
        return false;
    }

    const std::vector<double>& rest() const { return rest_; }

private:
    std::int64_t rows_, columns_;
    const double* matrix_ = nullptr;
    std::vector<double> u_, trial_, rest_, factors_, diagonal_, shares_;
    std::vector<bool> tried_;
    std::vector<std::int64_t> passive_;

    const double* column(std::int64_t k) const { return matrix_ + k * rows_; }

    void find_rest() {
        std::fill(rest_.begin(), rest_.end(), 0.0);
        rest_[rows_ - 1] = -1;
        for (const std::int64_t k : passive_)
            for (std::int64_t i = 0; i < rows_; ++i) rest_[i] += u_[k] * column(k)[i];
    }

    // The column along which the sum of squares falls most, of those that are 0; none if it falls along none.
    std::int64_t choose() const {
        std::int64_t best = -1;
        double most = settled;
        for (std::int64_t k = 0; k < columns_; ++k) {
            if (tried_[k] || std::find(passive_.begin(), passive_.end(), k) != passive_.end()) continue;
            const double falls = -product(column(k), rest_.data(), rows_);
            if (falls > most) most = falls, best = k;
        }
        return best;
    }

    // The least squares of the passive columns, by reflections; false if one depends on those before it.
    bool fit() {
        const auto count = static_cast<std::int64_t>(passive_.size());
        if (count > rows_) return false;
        std::vector<double> right(rows_, 0.0);
        right[rows_ - 1] = 1;
        for (std::int64_t k = 0; k < count; ++k) {
            double* own = factors_.data() + k * rows_;
            std::copy(column(passive_[k]), column(passive_[k]) + rows_, own);
            for (std::int64_t j = 0; j < k; ++j) reflect(j, own);
            const double length = std::sqrt(product(own + k, own + k, rows_ - k));
            if (!(length > dependent)) return false;
            diagonal_[k] = own[k] > 0 ? -length : length;
            shares_[k] = 1 / (length * (length + std::fabs(own[k])));
            own[k] -= diagonal_[k];
            // What lies above the diagonal stays in the column, before the reflection.
            reflect(k, right.data());
        }
        for (std::int64_t k = count; k-- > 0;) {
            double value = right[k];
            for (std::int64_t j = k + 1; j < count; ++j) value -= factors_[j * rows_ + k] * trial_[passive_[j]];
            trial_[passive_[k]] = value / diagonal_[k];
        }
        return true;
    }

    void reflect(std::int64_t k, double* x) const {
        const double* own = factors_.data() + k * rows_;
        const double sum = shares_[k] * product(own + k, x + k, rows_ - k);
        for (std::int64_t i = k; i < rows_; ++i) x[i] -= sum * own[i];
    }

    // Takes the trial if it is positive, else as much of the way to it as is, and lets go what is 0 then.
    bool step_to_trial() {
        double share = 1;
        std::int64_t first = -1;
        for (const std::int64_t k : passive_)
            if (trial_[k] <= 0 && u_[k] <= share * (u_[k] - trial_[k])) share = u_[k] / (u_[k] - trial_[k]), first = k;
        std::vector<std::int64_t> kept;
        for (const std::int64_t k : passive_) {
            u_[k] = k == first ? 0 : u_[k] + share * (trial_[k] - u_[k]);
            if (u_[k] > 0) kept.push_back(k);
        }
        if (first < 0) return true;
        passive_ = kept;
        return false;
    }
};

// One step: gram = root root^T, then the limits by coordinates in which all directions cost alike.
class Limited {
public:
    explicit Limited(const Steps& all)
        : all_(all), root_(all.numbers * all.numbers), normals_(all.limits * all.numbers), beyond_(all.limits),
          systems_(all.limits * (all.numbers + 1)), shift_(all.numbers), squares_(all.numbers + 1, all.limits) {}

    // Changes a step; whether it lay beyond a limit.
    bool limit(std::int64_t n, double* step) {
        double most = 0;
        std::int64_t worst = -1;
        bool finite = true;
        for (std::int64_t i = 0; i < all_.limits; ++i) {
            double* normal = normals_.data() + i * all_.numbers;
            for (std::int64_t k = 0; k < all_.unknowns; ++k) {
                normal[k] = all_.slopes[(i * all_.unknowns + k) * all_.count + n];
                finite &= std::isfinite(normal[k]);
            }
            beyond_[i] = all_.values[i * all_.count + n] + product(normal, step, all_.unknowns);
            if (beyond_[i] > most) most = beyond_[i], worst = i;
        }
        if (worst < 0 || !finite) return false;
        if (!factor(all_.gram + n * all_.numbers * all_.numbers)) return true;
        // One limit is enough for most; where another one is passed then, all are looked at together.
        std::copy(normals_.data() + worst * all_.numbers, normals_.data() + (worst + 1) * all_.numbers, shift_.begin());
        forward(shift_.data());
        const double square = product(shift_.data(), shift_.data(), all_.numbers);
        if (!(square > 0)) return true;
        for (double& each : shift_) each *= most / square;
        backward(shift_.data());
        for (std::int64_t i = 0; i < all_.limits; ++i)
            if (beyond_[i] - product(normals_.data() + i * all_.numbers, shift_.data(), all_.unknowns) > all_.slack) {
                if (!all_at_once()) return true;
                break;
            }
        for (std::int64_t k = 0; k < all_.numbers; ++k)
            if (std::isfinite(shift_[k])) step[k] -= shift_[k];
        return true;
    }

private:
    const Steps& all_;
    std::vector<double> root_, normals_, beyond_, systems_, shift_;
    PositiveLeastSquares squares_;

    bool factor(const double* gram) {
        const std::int64_t numbers = all_.numbers;
        for (std::int64_t i = 0; i < numbers; ++i)
            for (std::int64_t j = 0; j <= i; ++j) {
                const double rest = gram[i * numbers + j] - product(root_.data() + i * numbers, root_.data() + j * numbers, j);
                if (i == j && !(rest > 0)) return false;
                root_[i * numbers + j] = i == j ? std::sqrt(rest) : rest / root_[j * numbers + j];
            }
        return true;
    }

    void forward(double* x) const {
        for (std::int64_t i = 0; i < all_.numbers; ++i)
            x[i] = (x[i] - product(root_.data() + i * all_.numbers, x, i)) / root_[i * all_.numbers + i];
    }

    void backward(double* x) const {
        for (std::int64_t i = all_.numbers; i-- > 0;) {
            x[i] /= root_[i * all_.numbers + i];
            for (std::int64_t k = 0; k < i; ++k) x[k] -= root_[i * all_.numbers + k] * x[i];
        }
    }

    // The shortest shift within all limits; false if there is none.
    bool all_at_once() {
        const std::int64_t numbers = all_.numbers, rows = numbers + 1;
        for (std::int64_t i = 0; i < all_.limits; ++i) {
            double* system = systems_.data() + i * rows;
            std::copy(normals_.data() + i * numbers, normals_.data() + (i + 1) * numbers, system);
            forward(system);
            system[numbers] = beyond_[i];
            const double length = std::sqrt(product(system, system, rows));
            const bool known = std::isfinite(length) && length > 0;
            for (std::int64_t k = 0; k < rows; ++k) system[k] = known ? system[k] / length : 0;
        }
        if (!squares_.solve(systems_.data())) return false;
        const std::vector<double>& rest = squares_.rest();
        if (std::fabs(rest[numbers]) < nowhere) return false;
        for (std::int64_t k = 0; k < numbers; ++k) shift_[k] = -rest[k] / rest[numbers];
        backward(shift_.data());
        return true;
    }
};

}  // namespace

bool limit_steps(const Steps& steps, double* step, std::uint8_t* changed, Watch& watch) {
    Limited limited(steps);
    std::copy(steps.step, steps.step + steps.count * steps.numbers, step);
    for (std::int64_t n = 0; n < steps.count; ++n) {
        changed[n] = limited.limit(n, step + n * steps.numbers);
        const std::int64_t own = steps.limits * steps.unknowns;
        if (!spend(watch, changed[n] ? 10 * own + steps.numbers * steps.numbers * steps.numbers : own)) return false;
    }
    return true;
}

}  // namespace gruebler::design
