#include "space/modes.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "space/closing.hpp"

namespace gruebler::space {
namespace {

constexpr double first_step = 0.05;             // of the way: one that is too long is taken again, shorter
constexpr double shortest = 1e-10;              // a path that needs such a step is lost
constexpr double shorter = 0.4, longer = 1.8;   // a step that failed; after two in a row that did not
constexpr int most_steps = 5000;                // of a path: one of so many goes nowhere
constexpr int most_turns = 3;  // of the corrector, each squares the error; more say that the step is too long
constexpr int polishing_turns = 4;              // at the end, up to the last digit
constexpr double settled = 1e-9;                // relative: the corrector has arrived
constexpr double gain = 0.1;                    // what a turn of the corrector must leave at most of the change before
constexpr double far = 0.7;                     // radians: turns of balls are counted anew
constexpr double infinite = 1e8;                // an entry of a frame
constexpr std::int64_t work_of_a_step = 10000;  // nanoseconds

using Point = std::vector<Complex>;

double largest(const Point& point) {
    double most = 0;
    for (const Complex& u : point) {
        const double size = algebra::modulus(u);
        if (!(size <= std::numeric_limits<double>::max())) return std::numeric_limits<double>::infinity();
        most = size > most ? size : most;
    }
    return most;
}

class Tracker {
public:
    Tracker(const Structure& structure, const Way& way, double loose)
        : structure_(structure), closing_(structure, way), loose_(loose), place_(size()), guess_(size()), change_(size()) {
        for (Point& slope : slopes_) slope.resize(size());
    }

    std::int64_t steps = 0;

    void begin(const Complex* start, const Complex* turns) {
        for (std::size_t i = 0; i < size(); ++i) place_[i] = start[i];
        for (std::size_t i = 0; i < closing_.turns.size(); ++i) closing_.turns[i] = turns[i];
    }

    // Follows the path; false if the watch ends the work. Runge and Kutta predict, Newton corrects.
    bool follow(double& time, Watch& watch) {
        double step = first_step;
        int in_a_row = 0;
        time = 0, steps = 0;
        while (time < 1) {
            if (!spend(watch, work_of_a_step)) return false;
            if (++steps > most_steps || step < shortest) return true;
            const double left = 1 - time, end = step < left ? time + step : 1;
            if (!predict(time, end) || !correct(end)) {
                step *= shorter;
                in_a_row = 0;
                continue;
            }
            time = end;
            place_.swap(guess_);
            if (++in_a_row > 1) step *= longer, in_a_row = 0;
            if (count_anew() > infinite) return true;
        }
        polish();
        return true;
    }

    void write(double time, Complex* end, Complex* turns, Complex* frames) {
        closing_.evaluate(place_.data(), time);
        for (std::size_t i = 0; i < size(); ++i) end[i] = place_[i];
        for (std::size_t i = 0; i < closing_.turns.size(); ++i) turns[i] = closing_.turns[i];
        for (int k = 0; k < structure_.nodes; ++k)
            write_frame(closing_.frame(k), frames + k * frame_size);
    }

private:
    Structure structure_;
    Closing closing_;
    double loose_;
    Point place_, guess_, change_, slopes_[4];

    std::size_t size() const { return static_cast<std::size_t>(structure_.unknowns); }

    bool slope(const Point& at, double time, Point& out) {
        closing_.evaluate(at.data(), time);
        for (std::size_t i = 0; i < size(); ++i) out[i] = -closing_.rates[i];
        return closing_.solve(out);
    }

    bool predict(double begin, double end) {
        const double step = end - begin, parts[4] = {0, 0.5, 0.5, 1};
        for (int stage = 0; stage < 4; ++stage) {
            for (std::size_t i = 0; i < size(); ++i)
                guess_[i] = stage ? place_[i] + parts[stage] * step * slopes_[stage - 1][i] : place_[i];
            const double time = parts[stage] == 1 ? end : begin + parts[stage] * step;
            if (!slope(guess_, time, slopes_[stage])) return false;
        }
        for (std::size_t i = 0; i < size(); ++i)
            guess_[i] = place_[i] + step / 6 * (slopes_[0][i] + 2 * slopes_[1][i] + 2 * slopes_[2][i] + slopes_[3][i]);
        return true;
    }

    // The change of a turn of Newton's method, relative; infinite where it has none.
    double turn(Point& at, double time) {
        closing_.evaluate(at.data(), time);
        change_ = closing_.values;
        if (!closing_.solve(change_)) return std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < size(); ++i) at[i] = at[i] - change_[i];
        return largest(change_) / (1 + largest(at));
    }

    bool correct(double time) {
        double last = std::numeric_limits<double>::max();
        for (int k = 0; k < most_turns; ++k) {
            const double change = turn(guess_, time);
            if (!(change < loose_) || (k > 0 && change > settled && change > gain * last)) return false;
            if (change < settled) return true;
            last = change;
        }
        return false;
    }

    void polish() {
        for (int k = 0; k < polishing_turns; ++k) {
            guess_ = place_;
            if (!(turn(guess_, 1) < settled)) return;
            place_.swap(guess_);
        }
    }

    // Counts turns of balls from here where they have grown; the largest entry of a frame.
    double count_anew() {
        double most = 0;
        for (int k = 0; k < structure_.nodes; ++k) {
            for (const Complex& u : closing_.frame(k).r) most = algebra::size(u) > most ? algebra::size(u) : most;
            const std::int64_t* own = structure_.node + k * node_fields;
            if (own[5] < 0 || own[4] < 0) continue;
            Complex* angles = place_.data() + own[4];
            bool grown = false;
            for (int i = 0; i < 3; ++i) grown = grown || algebra::size(angles[i]) > far;
            if (!grown) continue;
            closing_.count_from(k, angles);
            for (int i = 0; i < 3; ++i) angles[i] = {0, 0};
        }
        return most;
    }
};

}  // namespace

bool follow(const Structure& structure, const Way& way, const Paths& paths, Watch& watch) {
    Tracker tracker(structure, way, paths.loose);
    for (std::int64_t path = 0; path < paths.count; ++path) {
        const auto own = path * structure.unknowns, balls = path * structure.balls * turn_size;
        tracker.begin(paths.starts + own, paths.turns + balls);
        if (!tracker.follow(paths.times[path], watch)) return false;
        tracker.write(paths.times[path], paths.ends + own, paths.end_turns + balls,
                      paths.frames + path * structure.nodes * frame_size);
        paths.steps[path] = tracker.steps;
    }
    return true;
}

}  // namespace gruebler::space
