#include "algebra/tracking.hpp"

#include <limits>

#include "algebra/system.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {
namespace {

constexpr double far = 1e8;         // a solution so many sizes away is at infinity
constexpr double quite_far = 1e4;   // a path that is lost out there goes there
constexpr double large = 30;        // sizes: beyond it terms of degree seven cancel, residuals need twice the digits
constexpr double fine = 1e-4;       // paths with finer steps have them throughout: near singular solutions need them
constexpr double shortest = 1e-10;  // a step
constexpr std::int64_t most_steps = 20000;
constexpr double first_step = 0.02;
constexpr double shorter = 0.4, longer = 1.6, much_longer = 1.5;
constexpr int good_steps = 2;  // in a row, and the next is longer
constexpr int corrections = 3;
constexpr double converged = 1e-9;
constexpr double converged_far_out = 1e-7;  // a third correction of that size is as good as rounding lets it get
constexpr double converging = 0.1;          // each correction at most this part of the last one
constexpr int newton_steps = 8;
constexpr double last_digit = 1e-15, nearly = 1e-12, halting = 0.5;

constexpr std::int64_t work_of_a_step = 1024;  // in the steps of the watch, of some nanoseconds
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Point {
    Complex z[unknowns];
};

Point read(const double* numbers) {
    Point point;
    for (int i = 0; i < unknowns; ++i) point.z[i] = {numbers[2 * i], numbers[2 * i + 1]};
    return point;
}

void write(const Point& point, double* numbers) {
    for (int i = 0; i < unknowns; ++i) {
        numbers[2 * i] = point.z[i].re;
        numbers[2 * i + 1] = point.z[i].im;
    }
}

double norm(const Point& point) {
    double largest = 0;
    for (const Complex& u : point.z) {
        const double each = modulus(u);
        if (!(each < infinity)) return infinity;
        largest = each > largest ? each : largest;
    }
    return largest;
}

// The largest change of an unknown, relative to it; small ones count against the largest of all.
double relative(const Point& change, const Point& point) {
    constexpr double share = 1e-3, least = 1e-300;
    const double floor = share * norm(point) + least;
    double largest = 0;
    for (int i = 0; i < unknowns; ++i) {
        const double each = modulus(change.z[i]) / (modulus(point.z[i]) + floor);
        if (!(each < infinity)) return infinity;
        largest = each > largest ? each : largest;
    }
    return largest;
}

void subtract(Point& point, const Point& change) {
    for (int i = 0; i < unknowns; ++i) point.z[i] = point.z[i] - change.z[i];
}

// The memory of a call, and one path after another.
class Tracker {
public:
    Tracker(Shape shape, const double* begin, const double* end, double loose)
        : shape_(shape), way_(Way::between(Parameters::read(begin), Parameters::read(end))), loose_(loose) {}

    Point here;
    std::int64_t steps = 0;

    // Follows the path from here; false if the watch ends the work.
    bool follow(PathEnd& end, Watch& watch) {
        end = PathEnd::arrived;
        steps = 0;
        double time = 0, step = first_step;
        int good = 0;
        bool first_slope = false;  // known, of a step that was not taken
        while (time < 1) {
            if (!spend(watch, work_of_a_step)) return false;
            ++steps;
            if (steps > most_steps || step < shortest) {
                end = norm(here) > quite_far ? PathEnd::infinite : PathEnd::failed;
                return true;
            }
            step = step < 1 - time ? step : 1 - time;
            bool quick = false;
            if (predict(time, step, first_slope) && correct(quick)) {
                time += step;
                here = next_;
                first_slope = false;
                if (norm(here) > far) {
                    end = PathEnd::infinite;
                    return true;
                }
                if (++good >= good_steps) {
                    step *= longer;
                    good = 0;
                }
                if (quick) step *= much_longer;
            } else {
                step *= shorter;
                good = 0;
            }
        }
        return true;
    }

private:
    Shape shape_;
    Way way_;
    double loose_;
    Parameters task_;  // of the moment
    Matrix jacobian_;
    Lanes right_;
    Point slopes_[4], next_;

    // How fast the path goes at a place and a time; false where that is not known.
    bool slope(const Point& place, double time, Point& out) {
        way_.at(time, task_);
        evaluate<Wanted::motion>(place.z, task_, way_.speed, shape_, jacobian_, right_);
        if (!solve(jacobian_, right_, out.z)) return false;
        for (Complex& u : out.z) u = -u;
        return true;
    }

    void go(double step, const Point& slope) {
        for (int i = 0; i < unknowns; ++i) next_.z[i] = here.z[i] + step * slope.z[i];
    }

    // Runge and Kutta's step of order four. The task of its end is left in `task_`.
    bool predict(double time, double step, bool& first_slope) {
        if (!first_slope && !slope(here, time, slopes_[0])) return false;
        first_slope = true;
        go(0.5 * step, slopes_[0]);
        if (!slope(next_, time + step * 0.5, slopes_[1])) return false;
        go(0.5 * step, slopes_[1]);
        if (!slope(next_, time + step * 0.5, slopes_[2])) return false;
        go(step, slopes_[2]);
        if (!slope(next_, time + step, slopes_[3])) return false;
        const double sixth = step / 6;
        for (int i = 0; i < unknowns; ++i)
            next_.z[i] = here.z[i] + sixth * (slopes_[0].z[i] + 2 * slopes_[1].z[i] + 2 * slopes_[2].z[i] +
                                              slopes_[3].z[i]);
        return true;
    }

    // Newton's method from the prediction; whether it converges at once, and whether the first correction was enough.
    bool correct(bool& quick) {
        double last = infinity;
        for (int turn = 0; turn < corrections; ++turn) {
            evaluate<Wanted::value>(next_.z, task_, way_.speed, shape_, jacobian_, right_);
            if (loose_ < fine || norm(next_) > large) evaluate_sharply(next_.z, task_, shape_, right_);
            Point correction;
            if (!solve(jacobian_, right_, correction.z)) return false;
            subtract(next_, correction);
            const double change = relative(correction, next_);
            if (!(change < loose_)) return false;
            if (change < (turn < corrections - 1 ? converged : converged_far_out)) {
                quick = turn == 0;
                return true;
            }
            if (turn > 0 && change > converging * last) return false;
            last = change;
        }
        return false;
    }
};

// Newton's method for one solution; returns the last relative step.
double sharpen(Point& point, const Parameters& task, const Parameters& still, Shape shape) {
    Matrix jacobian;
    Lanes residuals;
    double last = infinity, step = infinity;
    for (int turn = 0; turn < newton_steps; ++turn) {
        evaluate<Wanted::value>(point.z, task, still, shape, jacobian, residuals);
        evaluate_sharply(point.z, task, shape, residuals);
        Point correction;
        if (!solve(jacobian, residuals, correction.z)) return infinity;
        subtract(point, correction);
        last = step;
        step = relative(correction, point);
        if (step < last_digit || (last < nearly && step > halting * last)) break;
    }
    return step;
}

}  // namespace

bool track(const Paths& paths, Watch& watch) {
    Tracker tracker({paths.positions, paths.points}, paths.begin, paths.end, paths.loose);
    for (std::int64_t k = 0; k < paths.count; ++k) {
        tracker.here = read(paths.starts + 2 * unknowns * k);
        PathEnd end;
        if (!tracker.follow(end, watch)) return false;
        write(tracker.here, paths.ends + 2 * unknowns * k);
        paths.status[k] = static_cast<std::int64_t>(end);
        paths.steps[k] = tracker.steps;
    }
    return true;
}

bool refine(const Solutions& solutions, Watch& watch) {
    const Parameters task = Parameters::read(solutions.task), still{};
    for (std::int64_t k = 0; k < solutions.count; ++k) {
        if (!spend(watch, work_of_a_step)) return false;
        Point point = read(solutions.z + 2 * unknowns * k);
        solutions.last_steps[k] = sharpen(point, task, still, {solutions.positions, solutions.points});
        write(point, solutions.z + 2 * unknowns * k);
    }
    return true;
}

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
