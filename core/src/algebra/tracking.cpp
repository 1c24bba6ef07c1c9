#include "algebra/tracking.hpp"

#include <limits>

#include "algebra/six_bar_guidance.hpp"
#include "algebra/six_bar_system.hpp"
#include "algebra/system.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {
namespace {

constexpr double far = 1e8;         // a solution so many sizes away is at infinity
constexpr double quite_far = 1e4;   // a path that is lost out there goes there
constexpr double large = 30;        // sizes: beyond it terms of degree seven cancel, residuals need twice the digits
constexpr double fine = 1e-4;       // paths with finer steps have them throughout: near singular solutions need them
constexpr double shortest = 1e-10;  // a step
constexpr std::int64_t most_steps = 20000;  // a path takes some two hundred: one of so many goes nowhere
constexpr double first_step = 0.02;  // of the way: one that is too long is taken again, shorter
constexpr double shorter = 0.4;  // a step that was not taken
constexpr int corrections = 3;  // each squares the error: more would say that the step is too long
constexpr int most_known = 4;  // places from which the next one is predicted
constexpr int most_known_far_out = 2;  // rounding spoils slopes there, and more places multiply what it does
constexpr double converged = 1e-9;  // relative: the next correction, which is left out, would be smaller
constexpr double converged_far_out = 1e-7;  // a third correction of that size is as good as rounding lets it get
constexpr double converging = 0.1;          // each correction at most this part of the last one
constexpr int newton_steps = 8;  // twice as many as lead from 0.1 to the last digit
constexpr double last_digit = 1e-15;  // relative: a step below it changes nothing
constexpr double nearly = 1e-12, halting = 0.5;  // from here on a step that does not halve the last one is rounding

constexpr std::int64_t work_of_a_step = 1024;  // in the steps of the watch, of some nanoseconds
constexpr double infinity = std::numeric_limits<double>::infinity();

// By the first correction of the last step, as a part of what is allowed: from 0.1 to 0.3 of it the step stays. Errors of the
// prediction go with its sixth or eighth power, so that the others are soon there, too.
double change_of_step(double part) { return part > 0.3 ? 0.7 : part > 0.1 ? 1 : part > 0.02 ? 1.3 : 1.6; }

template <int unknowns>
struct Point {
    Complex z[unknowns];
};

template <int unknowns>
Point<unknowns> read(const double* numbers) {
    Point<unknowns> point;
    for (int i = 0; i < unknowns; ++i) point.z[i] = {numbers[2 * i], numbers[2 * i + 1]};
    return point;
}

template <int unknowns>
void write(const Point<unknowns>& point, double* numbers) {
    for (int i = 0; i < unknowns; ++i) {
        numbers[2 * i] = point.z[i].re;
        numbers[2 * i + 1] = point.z[i].im;
    }
}

template <int unknowns>
double norm(const Point<unknowns>& point) {
    double largest = 0;
    for (const Complex& u : point.z) {
        const double each = modulus(u);
        if (!(each < infinity)) return infinity;
        largest = each > largest ? each : largest;
    }
    return largest;
}

// The largest change of an unknown, relative to it; small ones count against the largest of all.
template <int unknowns>
double relative(const Point<unknowns>& change, const Point<unknowns>& point) {
    constexpr double share = 1e-3;    // of the largest: what is smaller counts as large as that
    constexpr double least = 1e-300;  // so that no zero is divided by
    const double floor = share * norm(point) + least;
    double largest = 0;
    for (int i = 0; i < unknowns; ++i) {
        const double each = modulus(change.z[i]) / (modulus(point.z[i]) + floor);
        if (!(each < infinity)) return infinity;
        largest = each > largest ? each : largest;
    }
    return largest;
}

template <int unknowns>
void subtract(Point<unknowns>& point, const Point<unknowns>& change) {
    for (int i = 0; i < unknowns; ++i) point.z[i] = point.z[i] - change.z[i];
}

// The memory of a call, and one path after another.
template <class System>
class Tracker {
public:
    static constexpr int unknowns = System::unknowns;
    using Point = algebra::Point<unknowns>;
    using Lanes = LanesOf<unknowns>;
    using Task = TaskOf<unknowns>;

    Tracker(const System& system, const double* begin, const double* end, double loose)
        : system_(system), way_(Way<unknowns>::between(Task::read(begin), Task::read(end))), loose_(loose) {}

    std::int64_t steps = 0;

    // Where the path begins or has ended.
    Point& here() { return known_[0].place; }

    // Follows the path from here; false if the watch ends the work.
    bool follow(PathEnd& end, Watch& watch) {
        end = PathEnd::arrived;
        steps = 0;
        double step = first_step;
        begin();
        while (known_[0].time < 1) {
            if (!spend(watch, work_of_a_step)) return false;
            ++steps;
            if (steps > most_steps || step < shortest) {
                end = norm(here()) > quite_far ? PathEnd::infinite : PathEnd::failed;
                return true;
            }
            const double left = 1 - known_[0].time;
            step = step < left ? step : left;
            next_.time = step < left ? known_[0].time + step : 1;
            predict();
            double first_change = 0;
            if (!correct(first_change)) {
                step *= shorter;
                continue;
            }
            step *= change_of_step(first_change / loose_);
            keep();
            if (norm(here()) > far) {
                end = PathEnd::infinite;
                return true;
            }
        }
        return true;
    }

private:
    // A place of the path, and how fast the path goes there.
    struct Known {
        double time;
        Point place, slope;
    };

    System system_;
    Way<unknowns> way_;
    double loose_;
    Task task_;  // of the moment
    MatrixOf<unknowns> jacobian_;
    Lanes right_[2];
    Complex solution_[2][unknowns];
    Known known_[most_known], next_;  // the last first
    int count_ = 0;

    void begin() {
        known_[0].time = 0;
        count_ = 1;
        next_ = known_[0];
        evaluate_and_solve(next_);
        known_[0].slope = next_.slope;
    }

    void keep() {
        count_ = count_ < most_known ? count_ + 1 : count_;
        for (int i = count_ - 1; i > 0; --i) known_[i] = known_[i - 1];
        known_[0] = next_;
    }

    // Hermite: the polynomial with the last places and slopes, of degree 2 k - 1 for k of them.
    void predict() {
        const int most = norm(here()) > large ? most_known_far_out : most_known, count = count_ < most ? count_ : most;
        const double time = next_.time;
        Point& place = next_.place;
        for (Complex& u : place.z) u = {0, 0};
        for (int i = 0; i < count; ++i) {
            const Known& own = known_[i];
            double base = 1, slope = 0;  // Lagrange's polynomial, and its derivative at its own time
            for (int j = 0; j < count; ++j) {
                if (j == i) continue;
                const double gap = 1 / (own.time - known_[j].time);
                base *= (time - known_[j].time) * gap;
                slope += gap;
            }
            const double away = time - own.time, square = base * base;
            const double of_place = (1 - 2 * away * slope) * square, of_slope = away * square;
            for (int k = 0; k < unknowns; ++k)
                place.z[k] = place.z[k] + of_place * own.place.z[k] + of_slope * own.slope.z[k];
        }
    }

    // The correction of a place, and the slope there; false for a singular matrix.
    bool evaluate_and_solve(Known& at) {
        way_.at(at.time, task_);
        system_.evaluate_with_rates(at.place.z, task_, way_.speed, jacobian_, right_[0], right_[1]);
        if (loose_ < fine || norm(at.place) > large) system_.evaluate_sharply(at.place.z, task_, right_[0]);
        if (!solve(jacobian_, right_, solution_)) return false;
        for (int k = 0; k < unknowns; ++k) at.slope.z[k] = -solution_[1][k];
        return true;
    }

    // Newton's method from the prediction; whether it converges at once. What the next correction would be is told by the last
    // two: near by it squares their quotient, far out, where rounding spoils the matrix, each is the same part of the one
    // before. The slope is that before the last correction, too small to change what is predicted from it.
    bool correct(double& first_change) {
        double last = infinity;
        for (int turn = 0; turn < corrections; ++turn) {
            if (!evaluate_and_solve(next_)) return false;
            Point correction;
            for (int k = 0; k < unknowns; ++k) correction.z[k] = solution_[0][k];
            subtract(next_.place, correction);
            const double change = relative(correction, next_.place);
            if (!(change < loose_)) return false;
            if (turn == 0) first_change = change;
            const double part = turn > 0 ? change / last : 1, next = change * part * (norm(next_.place) > large ? 1 : part);
            if (next < converged || (turn == corrections - 1 && change < converged_far_out)) return true;
            if (turn > 0 && part > converging) return false;
            last = change;
        }
        return false;
    }
};

// Newton's method for one solution; returns the last relative step.
template <class System>
double sharpen(Point<System::unknowns>& point, const System& system, const TaskOf<System::unknowns>& task) {
    constexpr int unknowns = System::unknowns;
    MatrixOf<unknowns> jacobian;
    LanesOf<unknowns> residuals[1];
    double last = infinity, step = infinity;
    for (int turn = 0; turn < newton_steps; ++turn) {
        system.evaluate(point.z, task, jacobian, residuals[0]);
        system.evaluate_sharply(point.z, task, residuals[0]);
        Complex solution[1][unknowns];
        if (!solve(jacobian, residuals, solution)) return infinity;
        Point<unknowns> correction;
        for (int k = 0; k < unknowns; ++k) correction.z[k] = solution[0][k];
        subtract(point, correction);
        last = step;
        step = relative(correction, point);
        if (step < last_digit || (last < nearly && step > halting * last)) break;
    }
    return step;
}

template <class System>
bool track_all(const System& system, const Paths& paths, Watch& watch) {
    constexpr int unknowns = System::unknowns;
    Tracker<System> tracker(system, paths.begin, paths.end, paths.loose);
    for (std::int64_t k = 0; k < paths.count; ++k) {
        tracker.here() = read<unknowns>(paths.starts + 2 * unknowns * k);
        PathEnd end;
        if (!tracker.follow(end, watch)) return false;
        write(tracker.here(), paths.ends + 2 * unknowns * k);
        paths.status[k] = static_cast<std::int64_t>(end);
        paths.steps[k] = tracker.steps;
    }
    return true;
}

template <class System>
bool refine_all(const System& system, const Solutions& solutions, Watch& watch) {
    constexpr int unknowns = System::unknowns;
    const auto task = TaskOf<unknowns>::read(solutions.task);
    for (std::int64_t k = 0; k < solutions.count; ++k) {
        if (!spend(watch, work_of_a_step)) return false;
        Point<unknowns> point = read<unknowns>(solutions.z + 2 * unknowns * k);
        solutions.last_steps[k] = sharpen(point, system, task);
        write(point, solutions.z + 2 * unknowns * k);
    }
    return true;
}

// The answer of the work with the equations of a family.
template <class Given, class Work>
bool with_system(const Given& given, const Work& work) {
#ifndef GRUEBLER_NO_SIX_BARS
    if (given.family == Family::watt_1) return work(GuidanceSystem<10>{given.positions});
    if (given.family == Family::watt_1_free) return work(GuidanceSystem<14>{given.positions});
    if (given.family == Family::watt_2) return work(SixBarSystem<watt_2>{given.points});
    if (given.points > 8 && given.family == Family::stephenson_2)
        return work(SixBarSystem<stephenson_2, 10>{given.points});
    if (given.points > 8) return work(SixBarSystem<stephenson_3, 10>{given.points});
    if (given.family == Family::stephenson_2) return work(SixBarSystem<stephenson_2>{given.points});
    if (given.family == Family::stephenson_3) return work(SixBarSystem<stephenson_3>{given.points});
#endif
    return work(FourBarSystem{{given.positions, given.points}});
}

}  // namespace

bool track(const Paths& paths, Watch& watch) {
    return with_system(paths, [&](const auto& system) { return track_all(system, paths, watch); });
}

bool refine(const Solutions& solutions, Watch& watch) {
    return with_system(solutions, [&](const auto& system) { return refine_all(system, solutions, watch); });
}

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
