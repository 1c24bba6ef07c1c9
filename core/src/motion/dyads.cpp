#include "motion/dyads.hpp"

#include <cmath>

namespace gruebler::motion {
namespace {

constexpr double heron_noise = 4e-16;  // two roundings of each of the four factors of Heron's formula
constexpr double same_point = 1e-13;   // of the size: points nearer than some hundred roundings are one
constexpr double same_point_near_change = 1e-7;  // the same where other dyads are in a change point too: known to 1e-8 only

// RPR: how far the second outer joint lies left of the first, seen along the slide.
double offset(const DyadElements& e) {
    const Complex first = conjugate(e[inner_a].line) * (e[on_a].point[0] - e[inner_a].point[0]);
    const Complex second = conjugate(e[inner_b].line) * (e[on_b].point[0] - e[inner_b].point[0]);
    return second.y - first.y;
}

Complex first_vector(const DyadElements& e) { return e[inner_a].point[0] - e[on_a].point[0]; }
Complex second_vector(const DyadElements& e) { return e[inner_b].point[0] - e[on_b].point[0]; }

// The turn of a second body that slides along the line of its outer joint.
Complex turn_along(const DyadElements& e) { return e[outer_b].line * conjugate(e[on_b].line); }

double rrr_square(const DyadElements& e) {
    const Complex gap = e[outer_b].point[0] - e[outer_a].point[0];
    const Complex first = first_vector(e), second = second_vector(e);
    const double d = std::sqrt(dot(gap, gap)), r = std::sqrt(dot(first, first)), s = std::sqrt(dot(second, second));
    // Heron's formula: no digits are lost.
    const double sine = (r + s - d) * (s + d - r) * (d + r - s) * (d + r + s) / square(2 * r * s);
    const double noise = heron_noise * square(d + r + s) / (r * s);
    return -noise < sine && sine < 0 ? 0.0 : sine;
}

double rrp_square(const DyadElements& e, double size, bool driven) {
    const Complex first = first_vector(e);
    const Complex reach = e[outer_b].point[0] + turn_along(e) * second_vector(e) - e[outer_a].point[0];
    const double across = cross(e[outer_b].line, reach);
    if (driven) return (dot(first, first) - across * across) / (size * size);
    return 1 - across * across / dot(first, first);
}

double rpr_square(const DyadElements& e, double size) {
    const Complex gap = e[outer_b].point[0] - e[outer_a].point[0];
    const double off = offset(e);
    return (dot(gap, gap) - off * off) / (size * size);
}

void place_rrr(double root, const DyadElements& e, double size, BodyJet& a, BodyJet& b) {
    const Complex gap = e[outer_b].point[0] - e[outer_a].point[0];
    const Complex first = first_vector(e), second = second_vector(e);
    const double d = dot(gap, gap), l1 = dot(first, first), l2 = dot(second, second);
    Complex arm;
    if (!outer_joints_meet(Kind::rrr, e, size)) {
        arm = gap * Complex{(d + l1 - l2) / (2 * d), root * std::sqrt(l1 * l2) / d};
        a.turn = arm * inverse(first, l1);
    } else {  // any direction closes: the one that the body has already
        arm = a.turn * first;
    }
    b.turn = (arm - gap) * inverse(second, l2);
}

void place_rrp(double root, const DyadElements& e, double size, bool driven, BodyJet& a, BodyJet& b) {
    const Complex first = first_vector(e), line = e[outer_b].line;
    const double l1 = dot(first, first);
    b.turn = turn_along(e);
    const Complex reach = e[outer_b].point[0] + b.turn * second_vector(e) - e[outer_a].point[0];
    const double travel = root * (driven ? size : std::sqrt(l1)) - dot(line, reach);
    if (!(driven && outer_joints_meet(Kind::rrp, e, size)))  // else any direction closes: the one that the body has
        a.turn = (reach + travel * line) * inverse(first, l1);
    b.place[0] = e[outer_b].point[0] + travel * line - b.turn * e[on_b].point[0];
}

void place_rpr(double root, const DyadElements& e, double size, BodyJet& a, BodyJet& b) {
    Complex line;
    if (outer_joints_meet(Kind::rpr, e, size)) {  // any direction closes: the one that the body has already
        line = a.turn * e[inner_a].line;
    } else {
        const Complex gap = e[outer_b].point[0] - e[outer_a].point[0];
        line = gap * Complex{root * size, -offset(e)};
        line = line / std::sqrt(dot(line, line));
    }
    a.turn = line * conjugate(e[inner_a].line);
    b.turn = line * conjugate(e[inner_b].line);
}

void place_prp(const DyadElements& e, BodyJet& a, BodyJet& b) {
    const Complex line_a = e[outer_a].line, line_b = e[outer_b].line;
    a.turn = line_a * conjugate(e[on_a].line);
    b.turn = turn_along(e);
    const Complex start = e[outer_a].point[0] + a.turn * first_vector(e);
    const Complex end = e[outer_b].point[0] + b.turn * second_vector(e);
    const double sine = cross(line_a, line_b);
    a.place[0] = e[outer_a].point[0] + cross(end - start, line_b) * line_a / sine - a.turn * e[on_a].point[0];
    b.place[0] = e[outer_b].point[0] + cross(end - start, line_a) * line_b / sine - b.turn * e[on_b].point[0];
}

void place_rpp(const DyadElements& e, BodyJet& a, BodyJet& b) {
    const Complex line = e[outer_b].line;
    b.turn = turn_along(e);
    const Complex slide = b.turn * e[inner_b].line;
    a.turn = slide * conjugate(e[inner_a].line);
    a.place[0] = e[outer_a].point[0] - a.turn * e[on_a].point[0];
    const Complex miss =
        e[outer_b].point[0] + b.turn * second_vector(e) - a.place[0] - a.turn * e[inner_a].point[0];
    const double travel = -cross(slide, miss) / cross(slide, line);
    b.place[0] = e[outer_b].point[0] + travel * line - b.turn * e[on_b].point[0];
}

// The real p, q with p * left + q * right = target.
struct Pair {
    double p, q;
};

Pair solved(Complex left, Complex right, Complex target) {
    const double sine = cross(left, right);
    return {cross(target, right) / sine, cross(left, target) / sine};
}

// The k-th derivative of the vector between two points of a body whose rates up to k are written.
Complex arm(int k, const BodyJet& body, const ElementJet& from, const ElementJet& to) {
    Complex vector[most_orders + 1];
    for (int m = 0; m <= most_orders; ++m) vector[m] = to.point[m] - from.point[m];
    return rotated_derivative(k, body.turn, body.rate, vector);
}

// A way along a line, with its derivatives; those that are not yet known are zero.
struct Way {
    double d[most_orders + 1] = {};

    Complex along(int k, Complex line, const double* spin) const {
        const Complex way[most_orders + 1] = {{d[0], 0}, {d[1], 0}, {d[2], 0}, {d[3], 0}};
        return rotated_derivative(k, line, spin, way);
    }

    Complex along(int k, const ElementJet& element) const { return along(k, element.line, element.spin); }
};

// The k-th derivative of where the inner joint is, by way of one body.
Complex inner_of_a(int k, const DyadElements& e, const BodyJet& a) {
    return e[outer_a].point[k] + arm(k, a, e[on_a], e[inner_a]);
}

Complex inner_of_b(int k, const DyadElements& e, const BodyJet& b) {
    return e[outer_b].point[k] + arm(k, b, e[on_b], e[inner_b]);
}

// The k-th derivative of the origin of a body one of whose points lies on an outer joint.
Complex origin(int k, const BodyJet& body, const ElementJet& outer, const ElementJet& on) {
    return outer.point[k] - rotated_derivative(k, body.turn, body.rate, on.point);
}

void rrr_rates(int order, const DyadElements& e, BodyJet& a, BodyJet& b) {
    const Complex first = a.turn * first_vector(e), second = b.turn * second_vector(e);
    for (int k = 1; k <= order; ++k) {
        const Complex target = inner_of_b(k, e, b) - inner_of_a(k, e, a);
        const Pair rates = solved(left(first), -left(second), target);
        a.rate[k - 1] = rates.p;
        b.rate[k - 1] = rates.q;
        a.place[k] = origin(k, a, e[outer_a], e[on_a]);
        b.place[k] = origin(k, b, e[outer_b], e[on_b]);
    }
}

void rrp_rates(int order, const DyadElements& e, BodyJet& a, BodyJet& b) {
    const Complex line = e[outer_b].line;
    const Complex first = a.turn * first_vector(e), second = b.turn * second_vector(e);
    Way slide;
    slide.d[0] = dot(line, a.place[0] + a.turn * e[inner_a].point[0] - e[outer_b].point[0] - second);
    for (int k = 1; k <= order; ++k) {
        b.rate[k - 1] = e[outer_b].spin[k - 1] - e[on_b].spin[k - 1];
        const Complex target = inner_of_b(k, e, b) + slide.along(k, e[outer_b]) - inner_of_a(k, e, a);
        const Pair rates = solved(left(first), -line, target);
        a.rate[k - 1] = rates.p;
        slide.d[k] = rates.q;
        a.place[k] = origin(k, a, e[outer_a], e[on_a]);
        b.place[k] = origin(k, b, e[outer_b], e[on_b]) + slide.along(k, e[outer_b]);
    }
}

void rpr_rates(int order, const DyadElements& e, BodyJet& a, BodyJet& b) {
    const Complex line = a.turn * e[inner_a].line;
    const Complex first = a.turn * first_vector(e), second = b.turn * second_vector(e);
    Way slide;
    slide.d[0] = dot(line, second + e[outer_b].point[0] - e[outer_a].point[0] - first);
    const Complex lever = first - second + slide.d[0] * line;
    double spin[most_orders] = {};  // of the line, as far as it is known
    for (int k = 1; k <= order; ++k) {
        // The slide turns as one; what turns in a body of several links is taken off again.
        a.rate[k - 1] = -e[inner_a].spin[k - 1];
        b.rate[k - 1] = -e[inner_b].spin[k - 1];
        const Complex target = inner_of_b(k, e, b) - inner_of_a(k, e, a) - slide.along(k, line, spin);
        const Pair rates = solved(left(lever), line, target);
        a.rate[k - 1] += rates.p;
        b.rate[k - 1] += rates.p;
        spin[k - 1] = a.rate[k - 1] + e[inner_a].spin[k - 1];
        slide.d[k] = rates.q;
        a.place[k] = origin(k, a, e[outer_a], e[on_a]);
        b.place[k] = origin(k, b, e[outer_b], e[on_b]);
    }
}

void prp_rates(int order, const DyadElements& e, BodyJet& a, BodyJet& b) {
    const Complex first = a.turn * first_vector(e), second = b.turn * second_vector(e);
    const Complex meet = a.place[0] + a.turn * e[inner_a].point[0];
    Way slide_a, slide_b;
    slide_a.d[0] = dot(e[outer_a].line, meet - e[outer_a].point[0] - first);
    slide_b.d[0] = dot(e[outer_b].line, meet - e[outer_b].point[0] - second);
    for (int k = 1; k <= order; ++k) {
        a.rate[k - 1] = e[outer_a].spin[k - 1] - e[on_a].spin[k - 1];
        b.rate[k - 1] = e[outer_b].spin[k - 1] - e[on_b].spin[k - 1];
        const Complex target = inner_of_b(k, e, b) + slide_b.along(k, e[outer_b]) - inner_of_a(k, e, a) -
                               slide_a.along(k, e[outer_a]);
        const Pair rates = solved(e[outer_a].line, -e[outer_b].line, target);
        slide_a.d[k] = rates.p;
        slide_b.d[k] = rates.q;
        a.place[k] = origin(k, a, e[outer_a], e[on_a]) + slide_a.along(k, e[outer_a]);
        b.place[k] = origin(k, b, e[outer_b], e[on_b]) + slide_b.along(k, e[outer_b]);
    }
}

void rpp_rates(int order, const DyadElements& e, BodyJet& a, BodyJet& b) {
    const Complex line = a.turn * e[inner_a].line;
    Way slide, second;  // along the outer line, along the line between both bodies
    slide.d[0] = dot(e[outer_b].line, b.place[0] + b.turn * e[on_b].point[0] - e[outer_b].point[0]);
    second.d[0] =
        dot(line, b.place[0] + b.turn * e[inner_b].point[0] - a.place[0] - a.turn * e[inner_a].point[0]);
    double spin[most_orders] = {};
    for (int k = 1; k <= order; ++k) {
        b.rate[k - 1] = e[outer_b].spin[k - 1] - e[on_b].spin[k - 1];
        a.rate[k - 1] = b.rate[k - 1] + e[inner_b].spin[k - 1] - e[inner_a].spin[k - 1];
        spin[k - 1] = a.rate[k - 1] + e[inner_a].spin[k - 1];
        const Complex target = inner_of_a(k, e, a) + second.along(k, line, spin) - inner_of_b(k, e, b) -
                               slide.along(k, e[outer_b]);
        const Pair rates = solved(e[outer_b].line, -line, target);
        slide.d[k] = rates.p;
        second.d[k] = rates.q;
        a.place[k] = origin(k, a, e[outer_a], e[on_a]);
        b.place[k] = origin(k, b, e[outer_b], e[on_b]) + slide.along(k, e[outer_b]);
    }
}

}  // namespace

double dyad_square(Kind kind, const DyadElements& e, double size, bool driven) {
    if (kind == Kind::rrr) return rrr_square(e);
    if (kind == Kind::rrp) return rrp_square(e, size, driven);
    if (kind == Kind::rpr) return rpr_square(e, size);
    return cross(kind == Kind::prp ? e[outer_a].line : turn_along(e) * e[inner_b].line, e[outer_b].line);
}

bool outer_joints_meet(Kind kind, const DyadElements& e, double size) {
    Complex gap = e[outer_b].point[0] - e[outer_a].point[0];
    double near = same_point;
    if (kind != Kind::rrr) {
        double off;
        if (kind == Kind::rrp) {
            off = cross(e[outer_b].line, gap + turn_along(e) * second_vector(e));
            gap = first_vector(e);
        } else {
            off = offset(e);
        }
        if (off * off > same_point * same_point * size * size) return false;
        near = same_point_near_change;
    }
    return dot(gap, gap) <= near * near * size * size;
}

void place_dyad(Kind kind, double root, const DyadElements& e, double size, bool driven, BodyJet& a, BodyJet& b) {
    switch (kind) {
        case Kind::rrr:
            place_rrr(root, e, size, a, b);
            break;
        case Kind::rrp:
            place_rrp(root, e, size, driven, a, b);
            break;
        case Kind::rpr:
            place_rpr(root, e, size, a, b);
            break;
        case Kind::prp:
            place_prp(e, a, b);
            break;
        default:
            place_rpp(e, a, b);
    }
    if (kind == Kind::rrr || kind == Kind::rrp || kind == Kind::rpr)
        a.place[0] = e[outer_a].point[0] - a.turn * e[on_a].point[0];
    if (kind == Kind::rrr || kind == Kind::rpr) b.place[0] = e[outer_b].point[0] - b.turn * e[on_b].point[0];
}

void dyad_rates(Kind kind, int order, const DyadElements& e, BodyJet& a, BodyJet& b) {
    for (int k = 0; k < most_orders; ++k) a.rate[k] = b.rate[k] = 0;
    switch (kind) {
        case Kind::rrr:
            return rrr_rates(order, e, a, b);
        case Kind::rrp:
            return rrp_rates(order, e, a, b);
        case Kind::rpr:
            return rpr_rates(order, e, a, b);
        case Kind::prp:
            return prp_rates(order, e, a, b);
        default:
            return rpp_rates(order, e, a, b);
    }
}

}  // namespace gruebler::motion
