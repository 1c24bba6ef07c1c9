// A point or a turn with its first three time derivatives; docs/theory/kinematics.md has the rules.
#pragma once

#include "motion/complex.hpp"

namespace gruebler::motion {

inline constexpr int most_orders = 3;

// Where a body is and how it moves.
struct BodyJet {
    Complex place[most_orders + 1];  // the origin
    Complex turn;                    // of modulus 1
    double rate[most_orders];        // angular velocity, acceleration, jerk
};

// The same for an element of a joint.
struct ElementJet {
    Complex point[most_orders + 1];
    Complex line;              // its direction, of modulus 1
    double spin[most_orders];  // the rates of the direction's angle
};

namespace {

// The derivative of that order of turn(t) b(t); `rate` are those of the angle, `b` the vector with its derivatives.
inline Complex rotated_derivative(int order, Complex turn, const double* rate, const Complex* b) {
    if (order == 0) return turn * b[0];
    const double w = rate[0];
    if (order == 1) return turn * (b[1] + imaginary(w) * b[0]);
    const Complex second = imaginary(rate[1]) - Complex{w * w, 0};
    if (order == 2) return turn * (b[2] + imaginary(2 * w) * b[1] + second * b[0]);
    const Complex third = imaginary(rate[2] - w * w * w) - Complex{3 * w * rate[1], 0};
    return turn * (b[3] + imaginary(3 * w) * b[2] + 3 * second * b[1] + third * b[0]);
}

// The jet of a body's point, the direction of a line of it and the rates of that direction.
inline void set_element_jet(int order, const BodyJet& body, Complex point, Complex line, ElementJet& element) {
    const Complex arm = body.turn * point;
    element.point[0] = body.place[0] + arm;
    element.line = body.turn * line;
    if (order < 1) return;
    const double w = body.rate[0];
    element.point[1] = body.place[1] + imaginary(w) * arm;
    element.spin[0] = w;
    if (order < 2) return;
    const double a = body.rate[1];
    element.point[2] = body.place[2] + (imaginary(a) - Complex{w * w, 0}) * arm;
    element.spin[1] = a;
    if (order < 3) return;
    const double j = body.rate[2];
    element.point[3] = body.place[3] + (imaginary(j - w * w * w) - Complex{3 * w * a, 0}) * arm;
    element.spin[2] = j;
}

// The motion of a link is known against a body, the body's motion is known: the link's motion against what that is.
inline void carry(int order, BodyJet& link, const BodyJet& body) {
    Complex known[most_orders + 1] = {};
    for (int k = 0; k <= order; ++k) known[k] = link.place[k];
    for (int k = 0; k <= order; ++k)
        link.place[k] = body.place[k] + rotated_derivative(k, body.turn, body.rate, known);
    for (int k = 0; k < order; ++k) link.rate[k] += body.rate[k];
    link.turn = link.turn * body.turn;
}

}  // namespace
}  // namespace gruebler::motion
