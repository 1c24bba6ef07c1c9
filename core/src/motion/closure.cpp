#include "motion/closure.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "motion/inverses.hpp"

namespace gruebler::motion {
namespace {

constexpr double turn_round = 2 * std::numbers::pi;

// Whether a number is a whole one from `least` to `most`, as an index.
bool is_index(double number, double least, double most) {
    return number >= least && number <= most && number == std::floor(number);
}

// How the bodies are turned: each sine and cosine once, for the first bodies, which are nearly always all.
class Turns {
public:
    Turns(const double* x, int bodies) : x_(x) {
        for (int b = 0; b < bodies && b < kept; ++b) turns_[b] = unit_vector(x[3 * b + 2]);
    }

    Complex of(int body) const { return body < kept ? turns_[body] : unit_vector(x_[3 * body + 2]); }

private:
    static constexpr int kept = 16;

    const double* x_;
    Complex turns_[kept];
};

// An element seen from where the unknowns put its body.
struct Side {
    Complex arm, point, line;

    Side(const ElementJet& element, int body, const double* x, const Turns& turns)
        : arm{0, 0}, point(element.point[0]), line(element.line) {
        if (body < 0) return;
        const Complex turn = turns.of(body);
        arm = turn * point;
        line = turn * line;
        point = arm + Complex{x[3 * body], x[3 * body + 1]};
    }
};

// What turns with the bodies counts so much in an equation, what the gap moves along `measure` so much.
struct Slopes {
    double turn_a = 0, turn_b = 0;
    Complex measure{0, 0};
};

double angle_of(int body, const double* x) { return body >= 0 ? x[3 * body + 2] : 0.0; }

double squared(Complex z) { return (z * conjugate(z)).x; }

}  // namespace

std::string read_condition(std::int64_t kind, const double* values, std::int64_t body_a, std::int64_t body_b,
                           std::int64_t bodies, const Laws& laws, Condition& condition) {
    if (kind < 0 || kind >= joint_kinds) return "is of no known kind";
    if (body_a < none || body_a >= bodies || body_b < none || body_b >= bodies) return "joins a body that is not there";
    const auto pieces = static_cast<double>(laws.count);
    if (!is_index(values[6], 0, pieces) || !is_index(values[5], 0, pieces) || values[5] + values[6] > pieces)
        return "has a law of pieces that are not there";
    const auto joint = static_cast<Joint>(kind);
    int arm = none;
    if (joint == Joint::train) {
        if (!is_index(values[3], none, static_cast<double>(bodies - 1))) return "has an arm that is not there";
        arm = static_cast<int>(values[3]);
    }
    condition = {joint,     static_cast<int>(body_a), static_cast<int>(body_b), arm,
                 values[0], values[1],                values[2],                values[3],
                 values[4], {static_cast<int>(values[5]), static_cast<int>(values[6]), values[7]}};
    return "";
}

double unwound_angle(Complex direction, double near) {
    const double angle = direction_angle(direction);
    return angle + turn_round * std::floor((near - angle) / turn_round + 0.5);
}

LawValue evaluate_law(const Laws& laws, const Law& law, double angle) {
    if (law.count == 0) return {angle, 1, 0, 0};
    const auto piece = [&](int k) { return laws.pieces + k * laws.width; };
    const double turns = std::floor((angle - piece(law.first)[0] + piece(law.first)[1]) / turn_round);
    const double place = angle - turn_round * turns;
    int low = law.first, high = law.first + law.count - 1;
    while (low < high) {
        const int middle = (low + high + 1) / 2;
        if (place >= piece(middle)[0] - piece(middle)[1]) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    const double half = piece(low)[1], u = (place - piece(low)[0]) / half;
    double f0 = 0, f1 = 0, f2 = 0, f3 = 0;
    for (auto k = laws.width - 1; k > 1; --k) {
        f3 = f3 * u + 3 * f2;
        f2 = f2 * u + 2 * f1;
        f1 = f1 * u + f0;
        f0 = f0 * u + piece(low)[k];
    }
    return {f0 + turns * law.growth, f1 / half, f2 / (half * half), f3 / (half * half * half)};
}

double closing(const Conditions& conditions, const double* x, int unknowns, double* residual, double* jacobian) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double size = conditions.size;
    const Turns turns(x, unknowns / 3);
    int row = 0;
    for (int c = 0; c < conditions.count; ++c) {
        const Condition& condition = conditions.list[c];
        const Joint kind = condition.kind;
        const int a = condition.body_a, b = condition.body_b;
        const Side one(conditions.sides[2 * c], a, x, turns), two(conditions.sides[2 * c + 1], b, x, turns);
        const Complex gap = two.point - one.point;
        double* slopes = jacobian + row * unknowns;
        for (int m = 0; m < equations(kind) * unknowns; ++m) slopes[m] = 0;
        if (kind == Joint::pin) {
            double* second = slopes + unknowns;
            residual[row] = gap.x;
            residual[row + 1] = gap.y;
            if (a >= 0) {
                slopes[3 * a] = second[3 * a + 1] = -1;
                slopes[3 * a + 2] = one.arm.y;
                second[3 * a + 2] = -one.arm.x;
            }
            if (b >= 0) {
                slopes[3 * b] = second[3 * b + 1] = 1;
                slopes[3 * b + 2] = -two.arm.y;
                second[3 * b + 2] = two.arm.x;
            }
            row += 2;
            continue;
        }
        if (kind == Joint::slide) {
            const Complex turn = conjugate(one.line) * two.line;
            residual[row] = turn.y * size;
            if (a >= 0) slopes[3 * a + 2] -= turn.x * size;
            if (b >= 0) slopes[3 * b + 2] += turn.x * size;
            ++row;
            slopes += unknowns;
        }
        const double factor_a = condition.factor_a, factor_b = condition.factor_b, value = condition.value;
        Slopes counts;
        const auto along = [&] { return conjugate(counts.measure) * gap; };
        switch (kind) {
            case Joint::pin:
                break;
            case Joint::slide:
            case Joint::ride:
                counts.measure = left(one.line);
                residual[row] = along().x - value;
                counts.turn_a = along().y;
                break;
            case Joint::reach:
                counts.measure = gap / value;
                residual[row] = (squared(gap) / value - value) / 2;
                break;
            case Joint::mesh: {
                const double first = unwound_angle(one.line * conjugate(gap), condition.near_a);
                const double second = unwound_angle(two.line * conjugate(gap), condition.near_b);
                const LawValue law = evaluate_law(conditions.laws, condition.law, first);
                residual[row] = factor_a * law.value + factor_b * second - value;
                counts.turn_a = factor_a * law.slope;
                counts.turn_b = factor_b;
                counts.measure = imaginary(-(counts.turn_a + factor_b)) * gap / squared(gap);
                break;
            }
            case Joint::polar: {
                const Complex seen = conjugate(one.line) * gap;
                const LawValue radius = evaluate_law(conditions.laws, condition.law, unwound_angle(seen, 0));
                const double square = squared(seen);
                residual[row] = factor_a * ((square > 0 ? logarithm(square) / 2 : -infinity) - radius.value);
                counts.measure = factor_a * (Complex{1, 0} - imaginary(radius.slope)) * gap / squared(gap);
                counts.turn_a = factor_a * radius.slope;
                break;
            }
            case Joint::face: {
                counts.measure = imaginary(factor_b) * one.line;
                const double normal = unwound_angle(-counts.measure * conjugate(two.line), 0);
                const LawValue height = evaluate_law(conditions.laws, condition.law, normal);
                residual[row] = along().x - height.value;
                counts.turn_a = along().y - height.slope;
                counts.turn_b = height.slope;
                break;
            }
            case Joint::train: {
                const int arm = condition.arm;
                const double first = angle_of(a, x) - angle_of(arm, x), second = angle_of(b, x) - angle_of(arm, x);
                const LawValue law = evaluate_law(conditions.laws, condition.law, first + condition.near_b);
                residual[row] = factor_a * law.value + factor_b * second - value;
                counts.turn_a = factor_a * law.slope;
                counts.turn_b = factor_b;
                if (arm >= 0) slopes[3 * arm + 2] -= counts.turn_a + factor_b;
                break;
            }
            case Joint::rack:
            case Joint::travel: {
                counts.measure = factor_b * one.line;
                const double angle = kind == Joint::rack
                                         ? unwound_angle(conjugate(one.line) * two.line, condition.near_a)
                                         : angle_of(b, x) - angle_of(a, x);
                residual[row] = factor_a * angle + along().x - value;
                counts.turn_a = along().y - factor_a;
                counts.turn_b = factor_a;
                break;
            }
        }
        if (a >= 0) {
            slopes[3 * a] -= counts.measure.x;
            slopes[3 * a + 1] -= counts.measure.y;
            slopes[3 * a + 2] += counts.turn_a - (conjugate(counts.measure) * left(one.arm)).x;
        }
        if (b >= 0) {
            slopes[3 * b] += counts.measure.x;
            slopes[3 * b + 1] += counts.measure.y;
            slopes[3 * b + 2] += counts.turn_b + (conjugate(counts.measure) * left(two.arm)).x;
        }
        ++row;
    }
    double largest = 0;
    for (int k = 0; k < row; ++k) {
        const double miss = std::fabs(residual[k]);
        if (!(miss <= largest)) largest = miss;  // so that NaN wins
    }
    return largest;
}

}  // namespace gruebler::motion
