#include "motion/closure_rates.hpp"

namespace gruebler::motion {
namespace {

Complex quotient(Complex a, Complex b) {
    const double square = b.x * b.x + b.y * b.y;
    return {(a.x * b.x + a.y * b.y) / square, (a.y * b.x - a.x * b.y) / square};
}

// The derivative of that order of the logarithm of a vector: of its length, and i times its direction.
Complex log_rate(int order, const Complex* gap) {
    const Complex first = quotient(gap[1], gap[0]);
    if (order == 1) return first;
    const Complex second = quotient(gap[2], gap[0]);
    if (order == 2) return second - first * first;
    return quotient(gap[3], gap[0]) - 3 * first * second + 2 * first * first * first;
}

// The derivative of that order of the squared length of a vector.
double square_rate(int order, const Complex* gap) {
    double rate = 2 * (conjugate(gap[0]) * gap[order]).x;
    if (order == 2) rate += 2 * (conjugate(gap[1]) * gap[1]).x;
    if (order == 3) rate += 6 * (conjugate(gap[1]) * gap[2]).x;
    return rate;
}

// The direction of an element with all its rates, those of its body included.
struct Direction {
    Complex line;
    double rate[most_orders];
};

// The direction of one side; its point is added to the gap, or taken off.
Direction add_side(int order, const ElementJet& element, int body, double sign, const BodyJet* bodies, Complex* gap) {
    Direction direction{element.line, {element.spin[0], element.spin[1], element.spin[2]}};
    if (body < 0) {
        for (int k = 0; k <= order; ++k) gap[k] += sign * element.point[k];
        return direction;
    }
    const BodyJet& jet = bodies[body];
    for (int k = 0; k <= order; ++k) {
        gap[k] += sign * jet.place[k];
        gap[k] += sign * rotated_derivative(k, jet.turn, jet.rate, element.point);
    }
    for (int k = 0; k < most_orders; ++k) direction.rate[k] += jet.rate[k];
    direction.line = jet.turn * direction.line;
    return direction;
}

// A law at the angle of a condition, and what its curvature adds to the derivative of that order.
struct Bend {
    double slope = 1, added = 0;
};

// `first` and `second` are the known rates of that angle.
Bend bend_of(int order, const LawValue& law, double first, double second) {
    Bend bend{law.slope, 0};
    if (order == 2) bend.added = law.second * first * first;
    if (order == 3) bend.added = law.third * first * first * first + 3 * law.second * first * second;
    return bend;
}

}  // namespace

void closing_rates(int order, const Conditions& conditions, const BodyJet* bodies, double* target) {
    int row = 0;
    for (int c = 0; c < conditions.count; ++c) {
        const Condition& condition = conditions.list[c];
        const Joint kind = condition.kind;
        Complex gap[most_orders + 1] = {};
        const Direction a = add_side(order, conditions.sides[2 * c], condition.body_a, -1, bodies, gap);
        const Direction b = add_side(order, conditions.sides[2 * c + 1], condition.body_b, 1, bodies, gap);
        if (kind == Joint::pin) {
            target[row] = -gap[order].x;
            target[row + 1] = -gap[order].y;
            row += 2;
            continue;
        }
        const double difference = b.rate[order - 1] - a.rate[order - 1];
        if (kind == Joint::slide) {
            target[row] = -difference * conditions.size;
            ++row;
        }
        if (kind == Joint::reach) {
            target[row] = -square_rate(order, gap) / (2 * condition.value);
            ++row;
            continue;
        }
        // The angle on which a law depends: its rates are those of a logarithm less a spin.
        double first = 1, second = 0;
        if (kind == Joint::mesh || kind == Joint::polar) {
            first = log_rate(1, gap).y - a.rate[0];
            second = (order > 2 ? log_rate(2, gap).y : 0.0) - a.rate[1];
        } else if (kind == Joint::face) {
            first = a.rate[0] - b.rate[0];
            second = a.rate[1] - b.rate[1];
        }
        Bend bend;
        if (condition.law.count > 0 || kind == Joint::mesh) {
            double angle;
            if (kind == Joint::mesh) {
                angle = unwound_angle(a.line * conjugate(gap[0]), condition.near_a);
                first = -first;
                second = -second;
            } else if (kind == Joint::polar) {
                angle = unwound_angle(conjugate(a.line) * gap[0], 0);
            } else {
                angle = unwound_angle(imaginary(-condition.factor_b) * a.line * conjugate(b.line), 0);
            }
            bend = bend_of(order, evaluate_law(conditions.laws, condition.law, angle), first, second);
        }
        const double factor_a = condition.factor_a, factor_b = condition.factor_b;
        if (kind == Joint::mesh) {
            const double turning = log_rate(order, gap).y;
            target[row] = -factor_a * (bend.slope * (a.rate[order - 1] - turning) + bend.added) -
                          factor_b * (b.rate[order - 1] - turning);
        } else if (kind == Joint::polar) {
            const Complex rate = log_rate(order, gap);
            target[row] = factor_a * (bend.slope * (rate.y - a.rate[order - 1]) + bend.added - rate.x);
        } else {
            const double back[most_orders] = {-a.rate[0], -a.rate[1], -a.rate[2]};
            const Complex seen = rotated_derivative(order, conjugate(a.line), back, gap);
            if (kind == Joint::rack) {
                target[row] = -(factor_a * difference + factor_b * seen.x);
            } else if (kind == Joint::face) {
                target[row] = bend.added - bend.slope * difference - factor_b * seen.y;
            } else {
                target[row] = -seen.y;
            }
        }
        ++row;
    }
}

}  // namespace gruebler::motion
