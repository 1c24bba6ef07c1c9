// Closing conditions of joints between bodies: residual and Jacobian.
#pragma once

#include <cstdint>
#include <string>

#include "motion/complex.hpp"
#include "motion/jets.hpp"

namespace gruebler::motion {

// Each joins a first and a second element. Lengths of the equations are in the unit of the points.
//
// pin     the points meet, two equations
// slide   the lines point the same way (times the size) and lie on one another, two equations
// ride    the second point lies `value` to the left of the first line
// reach   the points lie `value` apart
// mesh    factor_a times the first direction plus factor_b times the second, both against the line from point to point,
//         is `value`; the law stands for the first angle; near_a and near_b say how often directions have gone round
// rack    factor_a times the second direction against the first line, plus factor_b times the way of the second point
//         along that line, is `value`; near_a says how often
// polar   the second point lies on a curve about the first: seen from the first direction, the logarithm of its distance is
//         the law of its angle; factor_a is a length
// face    the first line touches a curve about the second point: its distance from the point is the law of the angle of
//         the outward normal against the second direction; factor_b is 1 if the point lies to the left of the line, else -1
// train   factor_a times the angle of the first body plus factor_b times that of the second, both against the angle of body
//         `arm`, is `value`; all angles as they stand in the unknowns, 0 for what is known; the law stands for the first
//         angle plus near_b
// travel  rack with the angles as they stand in the unknowns
enum class Joint : int { pin, slide, ride, reach, mesh, rack, polar, face, train, travel };

inline constexpr int joint_kinds = 10;
inline constexpr int none = -1;  // the body of what is known

namespace {
inline int equations(Joint kind) { return kind == Joint::pin || kind == Joint::slide ? 2 : 1; }
}  // namespace

// Laws in pieces: functions of an angle.
struct Laws {
    const double* pieces;  // (count, width): middle, half the width, coefficients of a polynomial on [-1, 1]
    std::int64_t count, width;
};

struct Law {
    int first, count;  // pieces; without any it is the angle itself
    double growth;     // in a turn
};

struct Condition {
    Joint kind;
    int body_a, body_b;  // that carry the elements, or none
    int arm;             // of a train
    double factor_a, factor_b, value;
    double near_a, near_b;
    Law law;
};

// The conditions of one group. `sides` has two elements for each: against their body or, of what is known, where it is.
struct Conditions {
    const Condition* list;
    const ElementJet* sides;
    int count;
    Laws laws;
    double size;
};

// A function and its derivatives at a place.
struct LawValue {
    double value, slope, second, third;
};

// Reads the eight numbers of a condition: factors, value, angles near by (or arm and offset), the law. Returns what is wrong,
// in words, or nothing.
std::string read_condition(std::int64_t kind, const double* values, std::int64_t body_a, std::int64_t body_b,
                           std::int64_t bodies, const Laws& laws, Condition& condition);

LawValue evaluate_law(const Laws& laws, const Law& law, double angle);

// The angle of a direction, with as many whole turns as bring it next to one near by.
double unwound_angle(Complex direction, double near);

// Writes residual and Jacobian, whose rows are `unknowns` long, at x (x, y, angle of each body); returns the largest
// residual, NaN if there is one.
double closing(const Conditions& conditions, const double* x, int unknowns, double* residual, double* jacobian);

}  // namespace gruebler::motion
