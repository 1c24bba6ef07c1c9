#include "motion/placing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/circle.hpp"
#include "motion/closure_rates.hpp"

namespace gruebler::motion {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

constexpr double farthest = 1;       // radians: a step that turns a wheel further is not taken, so that no turn is missed
constexpr double rounded = 1e-13;    // a squared root that is negative by less is zero but for some hundred roundings
constexpr double parallel = 1e-12;   // the sine of lines that are parallel but for rounding: such a dyad does not close
constexpr int newton_steps = 8;      // from so good a prediction it arrives in 3 to 5
constexpr double same_place = 1e-6;  // of the last step: a pose so near an older one says nothing of the bend between them
constexpr double deviation = 0.25;   // of the way moved: poses farther from the prediction may be another assembly mode
constexpr double first_deviation = 0.01;     // of the size: the same for the second pose, which the first alone lets expect
constexpr double straight_deviation = 0.02;  // of the way moved: the same behind a change point, crossed on a straight line
constexpr double no_deviation = 1e-7;  // of the size: nearer to the prediction nothing has jumped, however short the way
constexpr double ahead_part = 0.5;     // of the way to the expected zero of a determinant: no step leads farther
constexpr double determinant_kept = 0.1;  // of its last value: one that keeps less may have come through zero

template <class Part>
int largest(const Group* groups, int count, Part part) {
    int most = 1;
    for (int k = 0; k < count; ++k) most = std::max(most, part(groups[k]));
    return most;
}

int bodies_of(const Group& group) { return group.last_body - group.first_body; }
int conditions_of(const Group& group) { return group.last_condition - group.first_condition; }

void copy(const Remembered& from, Remembered& to) {  // never longer: no memory is asked for
    to.at = from.at;
    std::copy(from.roots.begin(), from.roots.end(), to.roots.begin());
    std::copy(from.unknowns.begin(), from.unknowns.end(), to.unknowns.begin());
    std::copy(from.determinants.begin(), from.determinants.end(), to.determinants.begin());
}

}  // namespace

Placing::Placing(const Plan& plan, int link_count)
    : links(link_count), last_turns(link_count, {1, 0}), whole_turns(link_count), signs(plan.dyad_count, 1),
      dyads(plan.dyad_count), plan_(plan), operation_of_(plan.dyad_count), drives_(4 * plan.drive_count),
      sides_(2 * largest(plan.groups, plan.group_count, conditions_of)),
      conditions_(largest(plan.groups, plan.group_count, conditions_of)),
      bodies_(largest(plan.groups, plan.group_count, bodies_of)),
      predicted_(3 * largest(plan.groups, plan.group_count, bodies_of)),
      room_(3 * largest(plan.groups, plan.group_count, bodies_of)) {
    trial = {0, std::vector<double>(plan.dyad_count), std::vector<double>(plan.unknown_count),
             std::vector<double>(plan.group_count)};
    for (Remembered& one : last) one = trial;
    reductions_.reserve(plan.group_count);
    for (int g = 0; g < plan.group_count; ++g) {
        const Group& group = plan.groups[g];
        set_conditions(group);
        reductions_.emplace_back(conditions_.data(), conditions_of(group), bodies_of(group));
    }
    for (int o = 0; o < plan.operation_count; ++o) {
        const Operation& operation = plan.operations[o];
        if (operation.kind >= Kind::rrr && operation.kind < Kind::group) operation_of_[operation.number] = o;
    }
}

void Placing::begin(const double* first_signs, const double* start) {
    filled = 0;
    singular = Singular::none;
    std::copy(first_signs, first_signs + signs.size(), signs.begin());
    for (DyadMemory& dyad : dyads) dyad = {not_a_number, 1, not_a_number, {1, 0}};
    std::copy(start, start + plan_.unknown_count, last[0].unknowns.begin());
}

void Placing::set_drives(const Path& path, double at) {
    const std::int64_t row = row_at(path, at), next = std::min(row + 1, path.rows - 1);
    const double part = at - static_cast<double>(row);
    for (int d = 0; d < path.drives; ++d) {
        drives_[d] = drive(path, row, d);
        if (part > 0) drives_[d] += part * (drive(path, next, d) - drive(path, row, d));
        if (part != 0) continue;
        for (int k = 0; k < path.orders; ++k) drives_[(k + 1) * path.drives + d] = speed(path, k, row, d);
    }
}

void Placing::move_drive(const Operation& operation, int order) {
    const Element &on_near = plan_.elements[operation.elements[Operation::near]],
                  &on_far = plan_.elements[operation.elements[Operation::far]];
    const BodyJet& near = links[on_near.link];
    BodyJet& far = links[on_far.link];
    const auto value = [&](int k) { return drives_[k * plan_.drive_count + operation.number]; };
    ElementJet& element = elements_[outer_a];
    set_element_jet(order, near, on_near.point, on_near.line, element);
    const Complex point[most_orders + 1] = {on_far.point, {0, 0}, {0, 0}, {0, 0}};
    if (operation.kind == Kind::turn) {
        far.turn = near.turn * unit_vector(operation.sign * value(0));
        far.place[0] = element.point[0] - far.turn * on_far.point;
        for (int k = 0; k < order; ++k) far.rate[k] = near.rate[k] + operation.sign * value(k + 1);
        for (int k = 1; k <= order; ++k)
            far.place[k] = element.point[k] - rotated_derivative(k, far.turn, far.rate, point);
        return;
    }
    far.turn = element.line * conjugate(on_far.line);
    // A negative drive is measured along the far link's line, to the near link's point.
    const double sign = operation.sign < 0 ? -1 : 1;
    Complex slide[most_orders + 1];
    for (int k = 0; k <= most_orders; ++k) slide[k] = {sign * value(k), 0};
    for (int k = 0; k < order; ++k) far.rate[k] = near.rate[k];
    for (int k = 0; k <= order; ++k)
        far.place[k] = element.point[k] + rotated_derivative(k, element.line, near.rate, slide) -
                       rotated_derivative(k, far.turn, near.rate, point);
}

// The signed root of a dyad at a place on the path, and whether it may be trusted.
Verdict Placing::trust_root(double square, int number, double at, double& root) const {
    root = 0;
    if (!(square >= -rounded)) return Verdict::apart;
    const double size = square > 0 ? std::sqrt(square) : 0.0, change = dyads[number].change;
    double sign = signs[number];
    if (!std::isnan(change)) {
        if (!(at <= change)) sign = dyads[number].after;  // 0 if nothing is known of what lies there
        root = size * sign;
        return sign != 0 ? Verdict::good : Verdict::approach;
    }
    root = size * sign;
    if (filled == 0) return Verdict::good;
    const double now = last[0].roots[number];
    if (filled > 1) {
        const double slope = (now - last[1].roots[number]) / (last[0].at - last[1].at);
        const double predicted = now + slope * (at - last[0].at);
        if (sign * predicted < expected * sign * now) return Verdict::approach;
    }
    return size < kept * std::fabs(now) ? Verdict::approach : Verdict::good;
}

// The same for a dyad of one mode: its lines may not become parallel.
Verdict Placing::trust_sine(double sine, int number) const {
    if (!(std::fabs(sine) > parallel) || (filled > 0 && sine * last[0].roots[number] < 0)) return Verdict::apart;
    return Verdict::good;
}

Verdict Placing::place_dyad_of(const Operation& operation, int order, double at) {
    for (int slot = 0; slot < slots; ++slot) {
        const Element& element = plan_.elements[operation.elements[slot]];
        set_element_jet(order, links[element.link], element.point, element.line, elements_[slot]);
    }
    const int number = operation.number;
    const Kind kind = operation.kind;
    const double square = dyad_square(kind, elements_, plan_.size, operation.driven);
    double root = square;
    const Verdict verdict =
        kind == Kind::prp || kind == Kind::rpp ? trust_sine(square, number) : trust_root(square, number, at, root);
    trial.roots[number] = root;
    if (verdict != Verdict::good) {
        which = number;
        return verdict;
    }
    BodyJet &a = links[operation.body_a], &b = links[operation.body_b];
    const bool may_meet = kind == Kind::rrr || kind == Kind::rpr || operation.driven;
    if (may_meet && outer_joints_meet(kind, elements_, plan_.size)) {
        if (dyads[number].met != at) {
            which = number;
            return Verdict::meet;
        }
        a.turn = dyads[number].direction;
    }
    place_dyad(kind, root, elements_, plan_.size, operation.driven, a, b);
    if (order > 0) dyad_rates(kind, order, elements_, a, b);
    return Verdict::good;
}

// Extrapolates the unknowns of a larger group from the last poses into the trial.
void Placing::predict(const Group& group, double at) {
    const double t0 = last[0].at, t1 = last[1].at, t2 = last[2].at;
    int count = filled;
    if (count > 2 && std::fabs(t0 - t2) < same_place * std::fabs(t0 - t1)) count = 2;  // there and back by equal steps
    // On a straight line through a change point near poses are too near one another for more.
    const bool straight = count > 2 && singular == Singular::jumped;
    for (int k = 3 * group.first_body; k < 3 * group.last_body; ++k) {
        double y = last[0].unknowns[k];
        if (straight) {
            y += (y - last[2].unknowns[k]) / (t0 - t2) * (at - t0);
        } else if (count > 1) {
            const double slope = (y - last[1].unknowns[k]) / (t0 - t1);
            y += slope * (at - t0);
            if (count > 2) {
                const double before = (last[1].unknowns[k] - last[2].unknowns[k]) / (t1 - t2);
                y += (slope - before) / (t0 - t2) * (at - t0) * (at - t1);
            }
        }
        trial.unknowns[k] = y;
    }
}

double Placing::zero_ahead(int group) const {
    const double now = last[0].determinants[group], past = last[1].determinants[group];
    if (now * past <= 0 || std::fabs(now) >= std::fabs(past) || last[0].at <= last[1].at) return infinity;
    return (last[0].at - last[1].at) * now / (past - now);
}

// Whether the last poses let expect that a larger group can be followed so far: not beyond where its determinant vanishes.
bool Placing::is_within_reach(int number, double at) const {
    if (filled == 0 || (singular == Singular::jumped && singular_group == number)) return true;
    if (last[0].determinants[number] == 0) return false;  // the start is singular: its side is not known
    const double ahead = filled > 1 ? zero_ahead(number) : infinity;
    return !(at - last[0].at > ahead_part * ahead && ahead > nearest * unit);
}

// Whether the trial of a larger group is near its prediction, and on the same side of singular positions.
bool Placing::is_expected(const Group& group, int number) const {
    const int first = 3 * group.first_body, end = 3 * group.last_body;
    double missed = 0, moved = 0;
    for (int k = first; k < end; ++k) {
        const double scale = k % 3 == 2 ? plan_.size : 1.0;
        missed = larger(missed, scale * std::fabs(trial.unknowns[k] - predicted_[k - first]));
        moved = larger(moved, scale * std::fabs(trial.unknowns[k] - last[0].unknowns[k]));
    }
    if (singular == Singular::jumped && singular_group == number) return missed <= straight_deviation * moved;
    if (missed > no_deviation * plan_.size) {
        if (missed > (filled > 1 ? deviation * moved : first_deviation * plan_.size)) return false;
    }
    return trial.determinants[number] / last[0].determinants[number] > determinant_kept;
}

// Angles that count whole turns are near what they were in the last pose.
void Placing::set_conditions(const Group& group) {
    for (int c = group.first_condition; c < group.last_condition; ++c) {
        const GroupCondition& condition = plan_.conditions[c];
        Condition& one = conditions_[c - group.first_condition];
        one = condition.numbers;
        if (condition.winding < 0) continue;
        one.near_a = last[0].unknowns[condition.winding];
        one.near_b = last[0].unknowns[condition.winding + 1];
    }
}

// Writes the angles that count whole turns into the trial; false if one has turned too far to be sure of them.
bool Placing::wind(const Group& group) {
    for (int c = group.first_condition; c < group.last_condition; ++c) {
        const GroupCondition& condition = plan_.conditions[c];
        const int first = condition.winding;
        if (first < 0) continue;
        Complex points[2], lines[2];
        for (int side = 0; side < 2; ++side) {
            const ElementJet& element = sides_[2 * (c - group.first_condition) + side];
            const int body = side == 0 ? condition.numbers.body_a : condition.numbers.body_b;
            points[side] = element.point[0];
            lines[side] = element.line;
            if (body < 0) continue;
            const double* x = trial.unknowns.data() + 3 * (group.first_body + body);
            const Complex turn = unit_vector(x[2]);
            points[side] = Complex{x[0], x[1]} + turn * points[side];
            lines[side] = turn * lines[side];
        }
        const double near[2] = {last[0].unknowns[first], last[0].unknowns[first + 1]};
        double* angles = trial.unknowns.data() + first;
        if (condition.numbers.kind == Joint::mesh) {
            const Complex along = conjugate(points[1] - points[0]);
            angles[0] = unwound_angle(lines[0] * along, near[0]);
            angles[1] = unwound_angle(lines[1] * along, near[1]);
        } else {
            angles[0] = unwound_angle(conjugate(lines[0]) * lines[1], near[0]);
            angles[1] = 0;
        }
        if (filled == 0) continue;
        for (int k = 0; k < 2; ++k)
            if (std::fabs(angles[k] - near[k]) > farthest) return false;
    }
    return true;
}

// In a singular place the rates of the bodies are not known.
void Placing::set_group_rates(int number, const Conditions& conditions, int order, bool known) {
    const Group& group = plan_.groups[number];
    const Reduction& reduction = reductions_[number];
    const int bodies = bodies_of(group), n = 3 * bodies;
    double* target = room_.residual.data();
    closing(conditions, trial.unknowns.data() + 3 * group.first_body, n, target, room_.jacobian.data());
    factor(reduction, n, room_);
    for (int k = 1; k <= order; ++k) {
        closing_rates(k, conditions, bodies_.data(), target);
        solve_factored(reduction, n, room_, target);
        for (int b = 0; b < bodies; ++b) {
            bodies_[b].place[k] = {target[3 * b], target[3 * b + 1]};
            bodies_[b].rate[k - 1] = known ? target[3 * b + 2] : not_a_number;
        }
    }
}

// Places the bodies of a larger group by Newton's method from what the last poses let expect.
bool Placing::place_group(int number, int order, double at) {
    const Group& group = plan_.groups[number];
    const bool in_it = singular == Singular::in_it && singular_group == number;
    if (!in_it && !is_within_reach(number, at)) return false;  // before any work: near a limit most tries end here
    const int bodies = bodies_of(group), n = 3 * bodies, count = conditions_of(group);
    for (int c = 0; c < count; ++c) {
        for (int side = 0; side < 2; ++side) {
            const Element& element = plan_.elements[plan_.conditions[group.first_condition + c].elements[side]];
            set_element_jet(order, links[element.link], element.point, element.line, sides_[2 * c + side]);
        }
    }
    predict(group, at);
    double* x = trial.unknowns.data() + 3 * group.first_body;
    std::copy(x, x + n, predicted_.begin());
    set_conditions(group);
    const Conditions conditions{conditions_.data(), sides_.data(), count, plan_.laws, plan_.size};
    if (in_it) {
        close_near_singular(conditions, x, n, room_);
    } else {
        NewtonEnd end = newton(conditions, reductions_[number], x, n, newton_steps, room_);
        if (filled == 0 && is_singular(conditions, x, n, end.steps >= 0, room_)) end = {0, 0};
        trial.determinants[number] = end.determinant;
        if (end.steps < 0) return false;
        if (filled > 0 && !is_expected(group, number)) return false;
    }
    if (!wind(group)) return false;
    for (int b = 0; b < bodies; ++b) bodies_[b] = {{{x[3 * b], x[3 * b + 1]}}, unit_vector(x[3 * b + 2]), {}};
    if (order > 0) set_group_rates(number, conditions, order, !in_it && trial.determinants[number] != 0);
    for (int b = 0; b < bodies; ++b) {
        BodyJet& link = links[plan_.roots[group.first_body + b]];
        link.turn = bodies_[b].turn;
        for (int k = 0; k <= order; ++k) link.place[k] = bodies_[b].place[k];
        for (int k = 0; k < order; ++k) link.rate[k] = bodies_[b].rate[k];
    }
    return true;
}

Verdict Placing::try_pose(int order, double at) {
    ++tried;
    for (BodyJet& link : links) {
        link.turn = {1, 0};
        link.place[0] = {0, 0};
        for (int k = 0; k < order; ++k) {
            link.place[k + 1] = {0, 0};
            link.rate[k] = 0;
        }
    }
    for (int o = 0; o < plan_.operation_count; ++o) {
        const Operation& operation = plan_.operations[o];
        switch (operation.kind) {
            case Kind::turn:
            case Kind::push:
                move_drive(operation, order);
                break;
            case Kind::group:
                if (place_group(operation.number, order, at)) break;
                which = operation.number;
                return Verdict::lost;
            case Kind::carry:
                carry(order, links[operation.body_a], links[operation.body_b]);
                break;
            default: {
                const Verdict verdict = place_dyad_of(operation, order, at);
                if (verdict != Verdict::good) return verdict;
            }
        }
    }
    return Verdict::good;
}

double Placing::stopped_square(int number) const {
    const Operation& operation = dyad(number);
    return dyad_square(operation.kind, elements_, plan_.size, operation.driven);
}

void Placing::accept(double at) {
    trial.at = at;
    copy(last[1], last[2]);
    copy(last[0], last[1]);
    copy(trial, last[0]);
    filled = std::min(filled + 1, 3);
    const double past = last[1].at;
    if ((last[0].at - past) * (past - last[2].at) <= 0) filled = std::min(filled, 2);  // turned back: two may be one
    for (std::size_t number = 0; number < dyads.size(); ++number) {
        DyadMemory& dyad = dyads[number];
        if (!(at >= dyad.change)) continue;
        if (dyad.after != 0) signs[number] = dyad.after;
        dyad.change = not_a_number;
    }
}

}  // namespace gruebler::motion
