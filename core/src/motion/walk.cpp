#include "motion/walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gruebler::motion {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

constexpr double flat = 1e-12;   // a squared root below this is zero: an exact change point
constexpr double noise = 1e-14;  // of squared roots: a hundred roundings
constexpr int pause_rows = 16;   // to walk after a sweep was stopped
constexpr double golden = 0.6180339887498949;  // of an interval: the golden section
constexpr int sections = 200;  // more than the golden section takes from any interval down to neighbouring numbers
constexpr double narrow = 1e-9;     // of the way searched: a least square is not known better, squares are flat there
constexpr double rounding = 1e-15;  // of a place on the path: shorter intervals have no number inside
constexpr double risen = 1.5;       // times the least square: an end above it lies behind the least place
constexpr double known = 1e-3;      // of the way: the least step on where nothing farther is known
constexpr double falling = 0.9;     // of the way on which a square falls to its end: nothing is decided, no step leads farther
constexpr double first_step = 0.01;   // of the longest step, where no poses let expect the next one
constexpr double most_tries = 1000;   // that fail, for each longest step of the way: ten times what any known motion takes
constexpr double reached = 1e-9;      // of what is left of the way: a step that misses the row by less goes to it
constexpr double same_place = 1e-9;   // of the longest step: a pose so near a row stands in it, and no step leads there
constexpr double behind_change = 1.0 / 64;  // of the longest step: the step behind a change point
constexpr double in_line = 1e-9;      // of the longest drive: directions of two rows that differ by less are one line
constexpr double longest_step = 1e6;  // rows, where the drives rest
constexpr double before_meeting = 1e-3;  // of the longest step: poses so far from where outer joints meet show their direction
constexpr double before_meeting_rows = 0.3;       // rows at most: three such poses lie within one row
constexpr double extrapolation[] = {3, -3, 1};    // weights of a parabola through three equal steps, one step ahead
constexpr double singular_from = 10 * nearest;    // of the longest step: nearer, rates have too few digits to judge by
constexpr double singular_to = 1e-3;    // of the longest step: farther, the determinant does not fall on a line yet
constexpr double growth_least = 0.05;   // of a determinant: its fall over three poses, for rates to be compared with it
constexpr double steady_rates = 0.1;    // of that fall: rates that change by less stay, and the place is a change point
constexpr double around = 6;            // times the way to a change point: a row nearer is placed between both sides
constexpr double both_sides = 3e-5;     // of the longest step: before a row is placed so, the near side is as near as that
constexpr double far_side = 1e-2;       // of the longest step: the far side then, where rounding no longer matters
constexpr double beyond_times = 8;  // the expected way to a change point, an r-th of it where r ranks are lost: twice for 4
constexpr double searched = 4;      // times the way to the expected zero of a root: as far its least square is looked for
constexpr double searched_least = 1e-13;  // of a place on the path: the least way to search, some hundred roundings
constexpr double across = 2;           // times the way to the zero of a root: a step that leads to the other side
constexpr double across_least = 1e-12;  // rows: the same, where the zero is as near as rounding

// Steps of the watch that a pose takes, of some nanoseconds each: for an operation, and for an unknown of larger groups.
constexpr std::int64_t operation_steps = 20, unknown_steps = 200;

}  // namespace

Walk::Walk(const Plan& plan, const Path& path, const Poses& poses, Sweep* sweep)
    : placing_(plan, poses.links), path_(path), poses_(poses), sweep_(sweep),
      placed_(path.rows > swept_rows ? swept_links(plan) : 0), bodies_(placed_ ? poses.links : 0) {
    if (placed_) rest(poses.links, bodies_.data());
}

Verdict Walk::try_at(int order, double at) {
    placing_.set_drives(path_, at);
    return placing_.try_pose(order, at);
}

// The squared root of one dyad somewhere near the last pose; NaN where something before it cannot be placed.
double Walk::square_at(double at, int number) {
    double& root = placing_.trial.roots[number];
    root = not_a_number;
    const Verdict verdict = try_at(0, at);
    if ((verdict == Verdict::approach || verdict == Verdict::apart) && placing_.which == number)
        return placing_.stopped_square(number);
    return root * root;  // it is known if only something behind it cannot be placed
}

// Where the square of a small root is least ahead of the last pose, and the sign behind that place.
//
// If the least square is zero the root goes through zero (an exact change point) and changes its sign; if it is above zero the
// linkage only passes near one. If it is below zero, there is a limit: returns where the square is negative.
Walk::Change Walk::look_for_change(double reach, double turn, int number) {
    const double begin = placing_.last[0].at;
    double low = begin, high = reach;
    double inner = high - golden * (high - low), outer = low + golden * (high - low);
    double at_inner = square_at(inner, number), at_outer = square_at(outer, number);
    double at = reach, lowest = infinity;    // the best so far: next to the zero dyads before this one may not be placed
    double far = low, beyond = -infinity;  // the farthest place at which they are, and the square there
    for (int section = 0; section < sections; ++section) {
        if (at_inner < lowest) at = inner, lowest = at_inner;
        if (at_outer < lowest) at = outer, lowest = at_outer;
        if (inner > far && !std::isnan(at_inner)) far = inner, beyond = at_inner;
        if (outer > far && !std::isnan(at_outer)) far = outer, beyond = at_outer;
        if (at_inner < -flat) return {inner, true};
        if (at_outer < -flat) return {outer, true};
        if (high - low < narrow * (reach - begin) || high - low < rounding * (1 + std::fabs(high))) break;
        if (!(at_inner > at_outer)) {  // or one of them is NaN: what cannot be placed lies farther on
            high = outer, outer = inner, at_outer = at_inner;
            inner = high - golden * (high - low);
            at_inner = square_at(inner, number);
        } else {
            low = inner, inner = outer, at_inner = at_outer;
            outer = low + golden * (high - low);
            at_outer = square_at(outer, number);
        }
    }
    const double end = square_at(reach, number);
    if (std::isnan(end)) {
        if (beyond <= risen * lowest + noise)  // nothing is decided as far as anything is known
            return {larger(far, begin + known * (reach - begin)), false};
    } else if (end <= risen * lowest + noise) {  // still falling up to there: nothing is decided yet
        return {reach == turn ? reach : begin + falling * (reach - begin), false};
    }
    DyadMemory& dyad = placing_.dyads[number];
    dyad.change = at;
    dyad.after = lowest < flat ? -placing_.signs[number] : placing_.signs[number];
    return {at, false};
}

// Counts whole turns, and writes a row unless it is -1.
void Walk::record(std::int64_t row) {
    for (int link = 0; link < poses_.links; ++link) {
        const BodyJet& jet = placing_.links[link];
        placing_.whole_turns[link] += crossed(jet.turn, placing_.last_turns[link]);
        placing_.last_turns[link] = jet.turn;
        if (row < 0) continue;
        turns_of(poses_, link)[row] = jet.turn;
        whole_of(poses_, link)[row] = static_cast<std::int32_t>(placing_.whole_turns[link]);
        for (int k = 0; k <= poses_.order; ++k) places_of(poses_, k, link)[row] = jet.place[k];
        for (int k = 0; k < poses_.order; ++k) rates_of(poses_, k, link)[row] = jet.rate[k];
    }
    if (row < 0) return;
    for (int m = 0; m < poses_.dyads; ++m) roots_of(poses_, m)[row] = placing_.trial.roots[m];
    for (int m = 0; m < poses_.unknown_count; ++m)
        poses_.unknowns[m * poses_.rows + row] = placing_.trial.unknowns[m];
}

// Remembers the rows up to this one as if they had been walked.
void Walk::recall(std::int64_t row) {
    placing_.filled = static_cast<int>(std::min<std::int64_t>(row + 1, 3));
    for (int k = 0; k < placing_.filled; ++k) {
        placing_.last[k].at = static_cast<double>(row - k);
        for (int m = 0; m < poses_.dyads; ++m) placing_.last[k].roots[m] = roots_of(poses_, m)[row - k];
    }
    for (int link = 0; link < poses_.links; ++link) {
        placing_.last_turns[link] = turns_of(poses_, link)[row];
        placing_.whole_turns[link] = whole_of(poses_, link)[row];
    }
}

// Goes back from a pose behind a change point to a row in it, of which the sides are not known.
void Walk::return_to(std::int64_t row) {
    Remembered& one = placing_.last[0];
    one.at = static_cast<double>(row);
    for (int m = 0; m < poses_.dyads; ++m) one.roots[m] = roots_of(poses_, m)[row];
    for (int m = 0; m < poses_.unknown_count; ++m) one.unknowns[m] = poses_.unknowns[m * poses_.rows + row];
    std::fill(one.determinants.begin(), one.determinants.end(), 0.0);
}

// The least of the roots, at most 1; 1 too if it is zero, since then nothing is lost.
double Walk::least_root() const {
    double lowest = 1;
    for (const double signed_root : placing_.last[0].roots) {
        const double root = std::fabs(signed_root);
        if (0 < root && root < lowest) lowest = root;
    }
    return lowest;
}

// Whether a root is going to be zero, or least, at a place that is known.
bool Walk::is_expecting() const {
    for (const DyadMemory& dyad : placing_.dyads)
        if (dyad.change < infinity) return true;
    return false;
}

Outcome Walk::follow(const double* signs, const double* start, Watch& watch) {
    placing_.begin(signs, start);
    Verdict verdict = try_at(poses_.order, 0);
    while (verdict == Verdict::meet) {
        meet(0);
        verdict = try_at(poses_.order, 0);
    }
    if (verdict != Verdict::good)
        return {End::start, 0, 0, verdict == Verdict::apart ? placing_.which : -1 - placing_.which};
    for (int link = 0; link < poses_.links; ++link) {
        placing_.last_turns[link] = placing_.links[link].turn;
        placing_.whole_turns[link] = 0;
    }
    placing_.accept(0);
    record(0);
    std::int64_t row = 1, pause = 2;
    Pace pace{1, infinity};
    while (row < path_.rows) {
        if (placed_ && row >= pause && pace.fault == infinity && !is_expecting()) {
            const std::int64_t end = sweep_(placing_.plan(), path_, placing_.signs.data(), row, placed_, poses_,
                                            bodies_.data());
            if (!spend(watch, lanes * operation_steps)) return {End::interrupted, row, 0, 0};
            pause = end + pause_rows;
            if (end > row) {
                row = pause = end;
                pace.step = 1;
                recall(row - 1);
                continue;
            }
        }
        const Reached there = walk_to(row, pace, watch);
        pace = there.pace;
        if (there.end != End::done) return {there.end, row, there.at, there.number};
        ++row;
    }
    return {End::done, row, static_cast<double>(row - 1), 0};
}

// From the last pose to a row, in as many steps as are needed.
Walk::Reached Walk::walk_to(std::int64_t row, Pace pace, Watch& watch) {
    const double target = static_cast<double>(row);
    const double past = placing_.unit;
    placing_.unit = unit(row);
    const double longest = smaller(1, placing_.unit);
    // Measured in rows: where they get shorter, so that it stays as long for the drives.
    double step = smaller(pace.step * larger(1, placing_.unit / past), longest);
    if (!remember(row)) {
        if (placing_.last[0].at != target - 1) return_to(row - 1);
        placing_.filled = 1;
        step = smaller(step, first_step * placing_.unit * least_root());
    }
    if (std::fabs(placing_.last[0].at - target) < same_place * placing_.unit) placing_.last[0].at = target;
    double at = placing_.last[0].at, fault = pace.fault;
    if (at >= target) {
        if (place_between(row)) return {End::done, target, {step, fault}, 0};
        return {End::singular, target - 1, {step, fault}, -1 - placing_.singular_group};
    }
    const auto ended = [&](End end, int number) {
        return Reached{end, larger(at, target - 1), {step, fault}, number};
    };
    const std::int64_t cost =
        operation_steps * placing_.plan().operation_count + unknown_steps * placing_.plan().unknown_count;
    double tries_left = most_tries * (1 + 1 / longest);  // good ones double the step: at most 50 between
    while (at < target) {
        const std::int64_t before = placing_.tried;
        const double left = target - at;
        const bool full = step >= left * (1 - reached);
        const double place = full ? target : at + step;
        const int order = full ? poses_.order : 0;
        const Verdict verdict = try_at(order, place);
        const int number = placing_.which;
        const auto given_up = [&] {
            return verdict == Verdict::lost ? ended(End::singular, -1 - number) : ended(End::limit, number);
        };
        if (verdict == Verdict::good) {
            const int turned = reversed();
            if (turned >= 0) {
                DyadMemory& dyad = placing_.dyads[turned];
                dyad.change = at;
                dyad.after = placing_.trial.roots[turned] > 0 ? -1 : 1;
                if (placing_.try_pose(order, place) != Verdict::good || reversed() >= 0)
                    return ended(End::singular, turned);
            }
            placing_.accept(place);
            record(full ? row : -1);
            at = place;
            if (at >= fault) fault = infinity;
            step = fault == infinity ? smaller(2 * step, longest) : (fault - at) / 2;
            if (step < path_.least * (1 + std::fabs(at)) && at < target) return ended(End::limit, number);
        } else if (verdict == Verdict::approach && std::fabs(placing_.last[0].roots[number]) < near_change &&
                   fault == infinity) {
            const Pace next = approach(step, number);
            step = next.step;
            fault = next.fault;
        } else if (verdict == Verdict::meet) {
            meet(place);
        } else {
            if (verdict == Verdict::apart) fault = smaller(fault, place);
            step = smaller(step, left) / 2;
            if (verdict == Verdict::lost && is_straight(number) && cross_change(row, number)) {
                const double here = placing_.last[0].at;
                step = larger(here - at, longest * behind_change);
                at = here;
            } else if (step < path_.least * (1 + std::fabs(at))) {
                return given_up();
            }
        }
        if (verdict != Verdict::good && --tries_left < 0) return given_up();
        if (!spend(watch, cost * (placing_.tried - before))) return ended(End::interrupted, 0);
    }
    return ended(End::done, 0);
}

// The number of an RPR dyad near a change point that a step has turned by more than a right angle, or -1.
//
// Where its outer joints meet, their line reverses; the slide goes straight on, and it is the assembly mode that changes. Steps
// are too short for any other turn like that. A driven arm of an RRP that comes through the length 0 reverses in the same way.
int Walk::reversed() const {
    for (int o = 0; o < placing_.plan().operation_count; ++o) {
        const Operation& operation = placing_.plan().operations[o];
        if (operation.kind != Kind::rpr && !operation.driven) continue;
        const int number = operation.number;
        const DyadMemory& dyad = placing_.dyads[number];
        if (dyad.change < infinity && dyad.after == placing_.signs[number])
            continue;  // it has only passed near a change point, and may turn fast
        const Complex turn = placing_.links[operation.body_a].turn, last = placing_.last_turns[operation.body_a];
        if (std::fabs(placing_.trial.roots[number]) < near_change && dot(turn, last) < 0) return number;
    }
    return -1;
}

// Measures the past in the step to this row, on one straight line with it or back; false if it predicts nothing.
bool Walk::remember(std::int64_t row) {
    if (row < 2) return false;
    double longest = 0, ratio = 0, off = 0;
    const auto change = [&](std::int64_t r, int d) { return drive(path_, r, d) - drive(path_, r - 1, d); };
    for (int d = 0; d < path_.drives; ++d) {
        const double past = change(row - 1, d);
        if (std::fabs(past) > longest) longest = std::fabs(past), ratio = change(row, d) / past;
    }
    for (int d = 0; d < path_.drives; ++d)
        off = larger(off, std::fabs(change(row, d) - ratio * change(row - 1, d)));
    if (ratio == 0 || off > in_line * longest * larger(1, std::fabs(ratio))) return steady(path_, row);
    const double before = static_cast<double>(row - 1);
    for (int k = 0; k < placing_.filled; ++k)
        placing_.last[k].at = before + (placing_.last[k].at - before) / ratio;
    // Back over a change point: the pose on its other side lies ahead.
    for (int k = 1; k < placing_.filled; ++k) {
        Remembered &last = placing_.last[0], &pose = placing_.last[k];
        if (pose.at > larger(before, last.at) && (last.at < before || is_other_side(pose))) {
            std::swap(last, pose);
            break;
        }
    }
    return true;
}

// Whether a change point of a larger group, and none of a dyad, lies between a pose and the last one.
bool Walk::is_other_side(const Remembered& pose) const {
    const Remembered& last = placing_.last[0];
    for (int m = 0; m < poses_.dyads; ++m)
        if (pose.roots[m] * last.roots[m] < 0) return false;
    for (std::size_t g = 0; g < pose.determinants.size(); ++g)
        if (pose.determinants[g] * last.determinants[g] < 0) return true;
    return false;
}

// The longest step of the drives, in rows, on the way to a row.
double Walk::unit(std::int64_t row) const {
    double longest = longest_step;
    for (int d = 0; d < path_.drives; ++d) {
        const double change = std::fabs(drive(path_, row, d) - drive(path_, row - 1, d));
        if (change * longest > placing_.plan().most[d]) longest = placing_.plan().most[d] / change;
    }
    return longest;
}

// Finds the direction of a dyad whose outer joints meet, from poses shortly before (at the start: after) it.
void Walk::meet(double at) {
    const int number = placing_.which, body = placing_.dyad(number).body_a;
    Complex turn{0, 0};
    for (int k = 0; k < 3; ++k) {
        if (path_.rows > 1) {
            const std::int64_t row = std::max<std::int64_t>(1, row_at(path_, std::ceil(at)));
            const double step = smaller(before_meeting_rows, before_meeting * unit(row)) * (k + 1);
            const double place = at < 1 && at - step < 0 ? at + step : at - step;
            if (try_at(0, place) == Verdict::good) {
                turn += extrapolation[k] * placing_.links[body].turn;
                continue;
            }
        }
        turn = at > 0 ? placing_.last_turns[body] : Complex{1, 0};
        break;
    }
    placing_.dyads[number].direction = turn / std::sqrt(dot(turn, turn));
    placing_.dyads[number].met = at;
}

// Whether a larger group comes straight to a singular position: then it is a change point, else a limit.
//
// At a limit the rates of the unknowns grow as the determinant falls, one over the other; at a change point they stay.
bool Walk::is_straight(int number) const {
    if (placing_.filled < 3) return false;
    const double ahead = placing_.zero_ahead(number) / placing_.unit;
    if (!(singular_from < ahead && ahead < singular_to)) return false;
    const Remembered *now = &placing_.last[0], *past = &placing_.last[1], *before = &placing_.last[2];
    const double growth = (before->determinants[number] - now->determinants[number]) /
                          (now->determinants[number] + past->determinants[number]);
    const Group& group = placing_.plan().groups[number];
    double bend = 0, slope = 0;
    for (int k = 3 * group.first_body; k < 3 * group.last_body; ++k) {
        const double scale = k % 3 == 2 ? placing_.plan().size : 1.0;
        const double late = (now->unknowns[k] - past->unknowns[k]) / (now->at - past->at);
        const double early = (past->unknowns[k] - before->unknowns[k]) / (past->at - before->at);
        bend = larger(bend, scale * std::fabs(late - early));
        slope = larger(slope, scale * std::fabs(early));
    }
    return growth > growth_least && bend < steady_rates * growth * slope;
}

// Goes straight through a change point of a larger group; a row that lies in it is placed between both sides.
bool Walk::cross_change(std::int64_t row, int number) {
    const double at = placing_.last[0].at, unit = placing_.unit, target = static_cast<double>(row);
    const double ahead = placing_.zero_ahead(number), left = target - at;
    const bool inside = left < around * ahead;
    if (inside && ahead > both_sides * unit) return false;
    const double beyond = inside ? target + far_side * unit : smaller(at + beyond_times * ahead, target);
    const bool full = beyond == target;
    placing_.singular = Singular::jumped;
    placing_.singular_group = number;
    if (inside) {
        for (int d = 0; d < path_.drives; ++d) {
            const double here = drive(path_, row, d);
            placing_.set_drive(d, here + (beyond - target) * (here - drive(path_, row - 1, d)));
        }
    } else {
        placing_.set_drives(path_, beyond);
    }
    const Verdict side = placing_.try_pose(full ? poses_.order : 0, beyond);
    placing_.singular = Singular::none;
    if (side == Verdict::good) {
        placing_.accept(beyond);
        if (!inside) {
            record(full ? row : -1);
            return true;
        }
    } else if (!inside || row < path_.rows - 1) {
        return false;
    }
    if (!place_between(row)) return false;
    if (placing_.last[0].at < target) placing_.accept(target);
    return true;
}

// Places a row between poses on both sides of a change point: as any other if it is far enough from it.
bool Walk::place_between(std::int64_t row) {
    const double target = static_cast<double>(row);
    if (placing_.last[0].at < target || try_at(poses_.order, target) != Verdict::good) {
        placing_.singular = Singular::in_it;
        const Verdict between = try_at(poses_.order, target);
        placing_.singular = Singular::none;
        if (between != Verdict::good) return false;
    }
    record(row);
    return true;
}

// The first row ahead at which the drives turn back or rest, or the last one, as far as the reach needs it.
//
// Behind it a root comes to the same change point once more, and its square has a second least value there.
double Walk::turn_ahead(double at, double reach) const {
    const std::int64_t last = path_.rows - 1;
    for (std::int64_t row = row_at(path_, at) + 1; row < last && static_cast<double>(row) < reach; ++row) {
        double forth = 0;
        for (int d = 0; d < path_.drives; ++d) {
            const double here = drive(path_, row, d);
            forth += (drive(path_, row + 1, d) - here) * (here - drive(path_, row - 1, d));
        }
        if (forth <= 0) return static_cast<double>(row);
    }
    return static_cast<double>(last);
}

// A small root that falls: looks ahead for the place where it is least.
Walk::Pace Walk::approach(double step, int number) {
    const double at = placing_.last[0].at;
    const double now = placing_.last[0].roots[number], past = placing_.last[1].roots[number];
    const double slope = (now - past) / (at - placing_.last[1].at);
    const double ahead = slope != 0 ? std::fabs(now / slope) : step;
    DyadMemory& dyad = placing_.dyads[number];
    dyad.change = not_a_number;
    const double turn = turn_ahead(at, at + searched * ahead);
    if (now * now < noise && at + ahead < turn) {  // an exact change point: squares do not tell its place
        dyad.change = at + ahead;
        dyad.after = -placing_.signs[number];
        return {larger(across * ahead, across_least), infinity};
    }
    const double reach = smaller(at + larger(searched * ahead, searched_least * (1 + at)), turn);
    const Change change = look_for_change(reach, turn, number);
    if (change.negative) return {change.place - at, change.place};
    if (!std::isnan(dyad.change)) return {larger(across * (change.place - at), across_least), infinity};
    dyad.change = change.place;  // falling all the way: as it was, up to there and no further
    dyad.after = 0;
    return {change.place - at, infinity};
}

}  // namespace gruebler::motion
