// Compiled once for each level of the processor. Of the standard library only what leaves no shared function behind.
#include "motion/sweep.hpp"

#include <math.h>

#include "motion/circle.hpp"

// The lanes of a loop are independent of one another. (`omp simd` would say so too, but GCC 12 then keeps the small structs of
// a lane in memory and vectorises nothing.)
#if defined(__clang__)
#define EACH_LANE _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define EACH_LANE _Pragma("GCC ivdep")
#else
#define EACH_LANE __pragma(loop(ivdep))
#endif

namespace gruebler::motion::inline GRUEBLER_LEVEL {
namespace {

// A point with its derivatives, and a body, in one lane.
template <int order>
struct Jet {
    Complex d[order + 1];
};

template <int order>
struct Body {
    Complex turn;
    Jet<order> origin;
    double rate[order + 1];  // one more than is used: no array is empty
};

template <int order>
inline Body<order> load(const BodyRows& rows, int i) {
    Body<order> body;
    body.turn = {rows.turn_x[i], rows.turn_y[i]};
    for (int k = 0; k <= order; ++k) body.origin.d[k] = {rows.x[k][i], rows.y[k][i]};
    for (int k = 0; k < order; ++k) body.rate[k] = rows.rate[k][i];
    return body;
}

template <int order>
inline void store(const Body<order>& body, BodyRows& rows, int i) {
    rows.turn_x[i] = body.turn.x;
    rows.turn_y[i] = body.turn.y;
    for (int k = 0; k <= order; ++k) {
        rows.x[k][i] = body.origin.d[k].x;
        rows.y[k][i] = body.origin.d[k].y;
    }
    for (int k = 0; k < order; ++k) rows.rate[k][i] = body.rate[k];
}

// A vector that turns with a body, with its derivatives.
template <int order>
inline Jet<order> arm_of(Complex arm, const double* rate) {
    Jet<order> jet;
    jet.d[0] = arm;
    if constexpr (order >= 1) jet.d[1] = rate[0] * left(arm);
    if constexpr (order >= 2) {
        const double w = rate[0] * rate[0], a = rate[1];
        jet.d[2] = {-(w * arm.x + a * arm.y), a * arm.x - w * arm.y};
    }
    if constexpr (order >= 3) {
        const double w = rate[0];
        jet.d[3] = Complex{-3 * w * rate[1], rate[2] - w * w * w} * arm;
    }
    return jet;
}

template <int order>
inline Jet<order> point_of(const Body<order>& body, Complex point) {
    Jet<order> jet = arm_of<order>(body.turn * point, body.rate);
    for (int k = 0; k <= order; ++k) jet.d[k] = body.origin.d[k] + jet.d[k];
    return jet;
}

// Where the origin is, given where a point is; turn and rates are known.
template <int order>
inline void set_origin(Body<order>& body, const Jet<order>& at, Complex point) {
    const Jet<order> arm = arm_of<order>(body.turn * point, body.rate);
    for (int k = 0; k <= order; ++k) body.origin.d[k] = at.d[k] - arm.d[k];
}

// An operation with what it works on.
struct Placed {
    const Element *outer_1, *on_1, *inner_1, *inner_2, *on_2, *outer_2;
    const BodyRows *p, *q;  // that carry the outer joints
    BodyRows *one, *two;
    double* roots;
    double sign;
};

// `values` and `rates` are the drive and its derivatives, each in a row of its own.
template <int order>
void place_turn(const BodyRows& near_rows, BodyRows& far_rows, Complex near_point, Complex far_point, double sign,
                const double (*values)[lanes], int count) {
    alignas(64) double x[lanes], y[lanes];
    int small = 0;
    for (int i = 0; i < count; ++i) small += fabs(sign * values[0][i]) < reduced;
    if (small == count) {
        EACH_LANE
        for (int i = 0; i < count; ++i) {
            const Complex turn = circle(sign * values[0][i]);
            x[i] = turn.x;
            y[i] = turn.y;
        }
    } else {
        for (int i = 0; i < count; ++i) {
            const Complex turn = unit_vector(sign * values[0][i]);
            x[i] = turn.x;
            y[i] = turn.y;
        }
    }
    EACH_LANE
    for (int i = 0; i < count; ++i) {
        const Body<order> near = load<order>(near_rows, i);
        Body<order> far;
        far.turn = near.turn * Complex{x[i], y[i]};
        for (int k = 0; k < order; ++k) far.rate[k] = near.rate[k] + sign * values[k + 1][i];
        set_origin(far, point_of(near, near_point), far_point);
        store(far, far_rows, i);
    }
}

template <int order>
void place_rrr(const Placed& by, int count) {
    const Complex first = by.inner_1->point - by.on_1->point, second = by.inner_2->point - by.on_2->point;
    const double l1 = dot(first, first), l2 = dot(second, second), sign = by.sign;
    const double area = sign * sqrt(l1) * sqrt(l2), scale = 1 / l1 / l2;
    const Complex back_1 = inverse(first, l1), back_2 = inverse(second, l2);
    const Complex point_p = by.outer_1->point, point_q = by.outer_2->point;
    const Complex point_1 = by.on_1->point, point_2 = by.on_2->point;
    const BodyRows &p_rows = *by.p, &q_rows = *by.q;
    BodyRows &rows_1 = *by.one, &rows_2 = *by.two;
    double* roots = by.roots;
    EACH_LANE
    for (int i = 0; i < count; ++i) {
        const Jet<order> p = point_of(load<order>(p_rows, i), point_p);
        const Jet<order> q = point_of(load<order>(q_rows, i), point_q);
        const Complex gap = q.d[0] - p.d[0];
        const double d = dot(gap, gap), m = (d + l1 - l2) / 2;
        const double root = sqrt((l1 * d - m * m) * scale);  // NaN where nothing can be assembled
        const double inverse_d = 1 / d;
        const Complex a = gap * Complex{m * inverse_d, area * root * inverse_d}, b = a - gap;
        roots[i] = sign * root;

        Body<order> one, two;
        one.turn = a * back_1;
        two.turn = b * back_2;
        if constexpr (order >= 1) {
            const double by_area = 1 / cross(a, b);
            const Complex t = q.d[1] - p.d[1];
            one.rate[0] = dot(t, b) * by_area;
            two.rate[0] = dot(t, a) * by_area;
            const double v = one.rate[0], w = two.rate[0], v2 = v * v, w2 = w * w;
            if constexpr (order >= 2) {
                const Complex u = q.d[2] - p.d[2] + v2 * a - w2 * b;
                one.rate[1] = dot(u, b) * by_area;
                two.rate[1] = dot(u, a) * by_area;
            }
            if constexpr (order >= 3) {
                const double v3 = v * v * v, w3 = w * w * w;
                const double va = 3 * v * one.rate[1], wa = 3 * w * two.rate[1];
                const Complex known = q.d[3] - p.d[3];
                const Complex u = {known.x + va * a.x - wa * b.x - v3 * a.y + w3 * b.y,
                                   known.y + (va * a.y - wa * b.y + v3 * a.x - w3 * b.x)};
                one.rate[2] = dot(u, b) * by_area;
                two.rate[2] = dot(u, a) * by_area;
            }
        }
        set_origin(one, p, point_1);
        set_origin(two, q, point_2);
        store(one, rows_1, i);
        store(two, rows_2, i);
    }
}

// Both bodies turn with the slide: the way from P to Q is slide * (way + i off).
template <int order>
void place_rpr(const Placed& by, double size, int count) {
    const Complex back_1 = conjugate(by.inner_1->line), back_2 = conjugate(by.inner_2->line);
    const double off = (back_2 * (by.on_2->point - by.inner_2->point)).y -
                       (back_1 * (by.on_1->point - by.inner_1->point)).y;
    const Complex point_p = by.outer_1->point, point_q = by.outer_2->point;
    const Complex point_1 = by.on_1->point, point_2 = by.on_2->point;
    const BodyRows &p_rows = *by.p, &q_rows = *by.q;
    BodyRows &rows_1 = *by.one, &rows_2 = *by.two;
    double *roots = by.roots, sign = by.sign;
    EACH_LANE
    for (int i = 0; i < count; ++i) {
        const Jet<order> p = point_of(load<order>(p_rows, i), point_p);
        const Jet<order> q = point_of(load<order>(q_rows, i), point_q);
        const Complex gap = q.d[0] - p.d[0];
        const double d = dot(gap, gap), travel = sign * sqrt(d - off * off), by_travel = 1 / travel;
        const Complex slide = {(gap.x * travel + gap.y * off) / d, (gap.y * travel - gap.x * off) / d};
        roots[i] = travel / size;

        Body<order> one, two;
        one.turn = slide * back_1;
        two.turn = slide * back_2;
        if constexpr (order >= 1) {
            const Complex t = q.d[1] - p.d[1];
            const double w = cross(slide, t) * by_travel, travel_1 = dot(slide, t) + w * off;
            one.rate[0] = w;
            if constexpr (order >= 2) {
                const Complex u = q.d[2] - p.d[2];
                const double a = (cross(slide, u) + w * w * off - 2 * w * travel_1) * by_travel;
                const double travel_2 = dot(slide, u) + a * off + w * w / by_travel;
                one.rate[1] = a;
                if constexpr (order >= 3) {
                    const double across = cross(slide, q.d[3] - p.d[3]);
                    one.rate[2] =
                        (across + 3 * (w * a * off - a * travel_1 - w * travel_2)) * by_travel + w * w * w;
                }
            }
        }
        for (int k = 0; k < order; ++k) two.rate[k] = one.rate[k];
        set_origin(one, p, point_1);
        set_origin(two, q, point_2);
        store(one, rows_1, i);
        store(two, rows_2, i);
    }
}

// The second body slides along a line of the frame.
template <int order>
void place_rrp(const Placed& by, int count) {
    const Complex line = by.outer_2->line, turn = line * conjugate(by.on_2->line);
    const Complex first = by.inner_1->point - by.on_1->point;
    const Complex second = turn * (by.inner_2->point - by.on_2->point);
    const double length = sqrt(dot(first, first)), sign = by.sign;
    const Complex back = inverse(first, length * length);
    const Complex start = by.outer_2->point, point_p = by.outer_1->point;
    const Complex point_1 = by.on_1->point, point_2 = by.on_2->point;
    const BodyRows& p_rows = *by.p;
    BodyRows &rows_1 = *by.one, &rows_2 = *by.two;
    double* roots = by.roots;
    EACH_LANE
    for (int i = 0; i < count; ++i) {
        const Jet<order> p = point_of(load<order>(p_rows, i), point_p);
        const Complex reach = start + second - p.d[0];
        const double sine = cross(line, reach) / length;
        const double root = sign * sqrt(1 - sine * sine);  // NaN where nothing can be assembled
        const double travel = root * length - line.x * reach.x - line.y * reach.y;
        const Complex a = reach + travel * line;
        roots[i] = root;

        Body<order> one, two;
        Jet<order> q;
        q.d[0] = start + travel * line;
        one.turn = a * back;
        two.turn = turn;
        if constexpr (order >= 1) {
            const double by_root = 1 / (root * length), along = dot(line, a), across = cross(line, a);
            const double w = -cross(line, p.d[1]) * by_root;
            one.rate[0] = w;
            q.d[1] = (dot(line, p.d[1]) - w * across) * line;
            if constexpr (order >= 2) {
                const double b = (w * w * across - cross(line, p.d[2])) * by_root;
                one.rate[1] = b;
                q.d[2] = (dot(line, p.d[2]) - (b * across + w * w * along)) * line;
                if constexpr (order >= 3) {
                    const double j = (3 * w * b * across - cross(line, p.d[3])) * by_root + w * w * w;
                    one.rate[2] = j;
                    q.d[3] = (dot(line, p.d[3]) - ((j - w * w * w) * across + 3 * w * b * along)) * line;
                }
            }
        }
        for (int k = 0; k < order; ++k) two.rate[k] = 0;
        set_origin(one, p, point_1);
        set_origin(two, q, point_2);
        store(one, rows_1, i);
        store(two, rows_2, i);
    }
}

// Whether a root is not small, and does not change too much.
inline int goes_on(double root, double last, double before) {
    constexpr double near_change = 1e-3, kept = 0.25, expected = 0.5;  // those of placing.hpp
    const double now = fabs(root), past = fabs(last);
    return static_cast<int>(now > near_change) & static_cast<int>(now > kept * past) &
           static_cast<int>((2 - expected) * past >= fabs(before));
}

// The first row from `row` on whose root does not.
std::int64_t trusted(const double* roots, std::int64_t row, std::int64_t end) {
    const double* root = roots + row;
    const int count = static_cast<int>(end - row);
    int good = 0;
    for (int i = 0; i < count; ++i) good += goes_on(root[i], root[i - 1], root[i - 2]);
    if (good == count) return end;
    int i = 0;
    while (i < count && goes_on(root[i], root[i - 1], root[i - 2])) ++i;
    return row + i;
}

// The first row from `row` on that is too far from the one before, or not in line.
std::int64_t near(const Path& path, const double* most, std::int64_t row, std::int64_t end) {
    if (row < 2) return row;
    if (path.drives == 1) {  // the common case, many rows at once
        const double* now = path.values + row;
        const int count = static_cast<int>(end - row);
        constexpr double faster = 1.5;  // that of `steady`
        int good = 0;
        for (int i = 0; i < count; ++i) {
            const double change = now[i] - now[i - 1], past = now[i - 1] - now[i - 2];
            good += static_cast<int>(change * past >= 0) & static_cast<int>(fabs(change) <= faster * fabs(past)) &
                    static_cast<int>(fabs(change) <= most[0]) & static_cast<int>(change != 0);
        }
        if (good == count) return end;
    }
    for (std::int64_t r = row; r < end; ++r) {
        if (!steady(path, r)) return r;
        for (int d = 0; d < path.drives; ++d)
            if (!(fabs(drive(path, r, d) - drive(path, r - 1, d)) <= most[d])) return r;
    }
    return end;
}

void count_turns(const Complex* turns, std::int32_t* whole, int count) {
    int any = 0;
    for (int i = 0; i < count; ++i) {
        const Complex now = turns[i], last = turns[i - 1];
        any += static_cast<int>((now.y < 0) != (last.y < 0)) & static_cast<int>(now.x + last.x < 0);
    }
    std::int32_t turned = whole[-1];
    if (any == 0) {
        for (int i = 0; i < count; ++i) whole[i] = turned;
        return;
    }
    for (int i = 0; i < count; ++i) whole[i] = turned += crossed(turns[i], turns[i - 1]);
}

void copy(const double* x, const double* y, Complex* to, int count) {
    EACH_LANE
    for (int i = 0; i < count; ++i) {
        to[i].x = x[i];
        to[i].y = y[i];
    }
}

void write(const BodyRows& body, const Poses& poses, int link, std::int64_t row, int count) {
    copy(body.turn_x, body.turn_y, turns_of(poses, link) + row, count);
    for (int k = 0; k <= poses.order; ++k) copy(body.x[k], body.y[k], places_of(poses, k, link) + row, count);
    for (int k = 0; k < poses.order; ++k) {
        const double* from = body.rate[k];
        double* to = rates_of(poses, k, link) + row;
        EACH_LANE
        for (int i = 0; i < count; ++i) to[i] = from[i];
    }
}

template <int order>
void place(const Plan& plan, const Operation& operation, const Path& path, const double* signs, std::int64_t row,
           int count, const Poses& poses, BodyRows* bodies) {
    const auto element = [&](int slot) { return plan.elements + operation.elements[slot]; };
    if (operation.kind == Kind::turn) {
        alignas(64) double values[order + 1][lanes];
        const int d = operation.number;
        for (int i = 0; i < count; ++i) values[0][i] = drive(path, row + i, d);
        for (int k = 0; k < order; ++k)
            for (int i = 0; i < count; ++i) values[k + 1][i] = speed(path, k, row + i, d);
        const Element &near = *element(Operation::near), &far = *element(Operation::far);
        place_turn<order>(bodies[near.link], bodies[far.link], near.point, far.point, operation.sign, values, count);
        return;
    }
    const Placed by{element(outer_a),
                    element(on_a),
                    element(inner_a),
                    element(inner_b),
                    element(on_b),
                    element(outer_b),
                    bodies + element(outer_a)->link,
                    bodies + element(outer_b)->link,
                    bodies + operation.body_a,
                    bodies + operation.body_b,
                    roots_of(poses, operation.number) + row,
                    signs[operation.number]};
    if (operation.kind == Kind::rrr) {
        place_rrr<order>(by, count);
    } else if (operation.kind == Kind::rpr) {
        place_rpr<order>(by, plan.size, count);
    } else {
        place_rrp<order>(by, count);
    }
}

template <int order>
std::int64_t sweep_rows(const Plan& plan, const Path& path, const double* signs, std::int64_t row, std::int64_t end,
                        const Poses& poses, BodyRows* bodies) {
    const int count = static_cast<int>(end - row);
    std::int64_t good = end;
    for (int o = 0; o < plan.operation_count; ++o) {
        const Operation& operation = plan.operations[o];
        place<order>(plan, operation, path, signs, row, count, poses, bodies);
        if (operation.kind != Kind::turn) good = trusted(roots_of(poses, operation.number), row, good);
    }
    return good;
}

}  // namespace

std::int64_t sweep(const Plan& plan, const Path& path, const double* signs, std::int64_t row, std::uint64_t placed,
                   const Poses& poses, BodyRows* bodies) {
    const std::int64_t most = row + lanes < path.rows ? row + lanes : path.rows;
    const std::int64_t end = near(path, plan.most, row, most);
    if (end == row) return row;
    std::int64_t good;
    switch (poses.order) {
        case 0:
            good = sweep_rows<0>(plan, path, signs, row, end, poses, bodies);
            break;
        case 1:
            good = sweep_rows<1>(plan, path, signs, row, end, poses, bodies);
            break;
        case 2:
            good = sweep_rows<2>(plan, path, signs, row, end, poses, bodies);
            break;
#ifdef GRUEBLER_NO_JERK
        default:
            return row;
#else
        default:
            good = sweep_rows<3>(plan, path, signs, row, end, poses, bodies);
#endif
    }
    const int count = static_cast<int>(good - row);
    for (int link = 0; link < poses.links; ++link) {
        write(bodies[link], poses, link, row, count);
        if (placed >> link & 1) {
            count_turns(turns_of(poses, link) + row, whole_of(poses, link) + row, count);
        } else {
            for (int i = 0; i < count; ++i) whole_of(poses, link)[row + i] = 0;
        }
    }
    return good;
}

}  // namespace gruebler::motion::inline GRUEBLER_LEVEL
