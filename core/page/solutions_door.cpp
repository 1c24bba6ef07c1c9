// The door to the page's synthesis: tasks and solutions in one block of memory. `explorer/src/points/homotopy.ts` is the
// other side.
//
// The block holds 64-bit words: a task complex[4, 8] to begin with and one to end with, then solutions complex[count, 8],
// then what is said of each. It is kept from call to call, and grows. Whoever wants an end of the work ends the worker.
#include <algorithm>
#include <vector>

#include "algebra/certificate.hpp"
#include "algebra/tracking.hpp"
#include "exports.hpp"

namespace gruebler::algebra {
namespace {

constexpr std::size_t task_words = 64, solution_words = 16;

std::vector<double> block;

bool goes_on(void*) { return true; }

double* begin() { return block.data(); }
double* end() { return begin() + task_words; }
double* solutions() { return end() + task_words; }
double* said(int count) { return solutions() + solution_words * static_cast<std::size_t>(count); }

}  // namespace

// The block, with room for so many solutions and what is said of them.
EXPORT double* reserve(int count) {
    const std::size_t words = 2 * task_words + (solution_words + 1) * static_cast<std::size_t>(count);
    if (block.size() < words) block.resize(words);
    return block.data();
}

// Follows solutions of the first task to the second, in place; how each ended is said: `PathEnd`.
EXPORT void track(int positions, int points, int count, double loose) {
    std::vector<std::int64_t> status(static_cast<std::size_t>(count)), steps(status.size());
    Watch watch{goes_on, nullptr};
    const Paths paths{Family::four_bars, positions, points, count, solutions(), begin(), end(), loose, solutions(),
                      status.data(), steps.data()};
    baseline::track(paths, watch);
    std::copy(status.begin(), status.end(), said(count));
}

// Newton's method for solutions of the second task, in place; the last relative step of each is said.
EXPORT void refine(int positions, int points, int count) {
    Watch watch{goes_on, nullptr};
    baseline::refine({Family::four_bars, positions, points, count, end(), solutions(), said(count)}, watch);
}

// Which solutions of the second task are proved, each different from all others: 1 is said of them, 0 of others.
EXPORT void certify(int positions, int points, int count) {
    std::vector<std::uint8_t> proved(static_cast<std::size_t>(count));
    Watch watch{goes_on, nullptr};
    algebra::certify({positions, points, count, end(), solutions(), proved.data()}, watch);
    std::copy(proved.begin(), proved.end(), said(count));
}

}  // namespace gruebler::algebra
