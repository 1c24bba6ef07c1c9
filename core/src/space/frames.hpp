// Vectors, frames and screws of real or complex numbers, and trees of joints: one kernel of closing conditions for both.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "algebra/complex.hpp"
#include "motion/circle.hpp"

namespace gruebler::space {

using algebra::Complex;

// What a node of the tree does: it stands still on its parent, which is a dimension; it turns, shifts, or does both, along
// an axis.
enum class Kind : std::int64_t { still, turns, shifts, screws };

// What a row asks: an offset along an axis of the first frame that is 0; an axis of the second frame at right angles to
// one of the first; a distance.
enum class RowKind : std::int64_t { offset, across, length };

inline constexpr int node_fields = 6, row_fields = 5, frame_size = 16, twist_size = 6, turn_size = 9;
inline constexpr int most_nodes = 4096, most_unknowns = 1024;  // more than linkages need

struct Structure {
    int nodes, rows, unknowns, balls;
    // [nodes, 6]: parent (one before, -1 for none), Kind, axis, sign, unknown (-1: its value is given), ball (-1: none).
    // At the first of the three turns of a ball stands where they are counted from.
    const std::int64_t* node;
    // [rows, 5]: RowKind, first and second node, axis, other axis.
    const std::int64_t* row;

    const std::int64_t* node_at(int k) const { return node + k * node_fields; }
    const std::int64_t* row_at(int k) const { return row + k * row_fields; }
};

// --- vectors -----------------------------------------------------------------------------------------------------------

template <class Number>
struct Vector {
    Number x[3];
};

template <class Number>
Vector<Number> operator+(const Vector<Number>& a, const Vector<Number>& b) {
    return {{a.x[0] + b.x[0], a.x[1] + b.x[1], a.x[2] + b.x[2]}};
}
template <class Number>
Vector<Number> operator-(const Vector<Number>& a, const Vector<Number>& b) {
    return {{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}};
}
template <class Number>
Vector<Number> operator*(Number k, const Vector<Number>& a) {
    return {{k * a.x[0], k * a.x[1], k * a.x[2]}};
}
template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}
template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
    return {{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

// --- frames ------------------------------------------------------------------------------------------------------------

// A rigid motion: the rotation by rows, where the origin goes.
template <class Number>
struct Frame {
    Number r[9];
    Number p[3];
    Vector<Number> axis(int i) const { return {{r[i], r[3 + i], r[6 + i]}}; }
    Vector<Number> origin() const { return {{p[0], p[1], p[2]}}; }
    Vector<Number> turned(const Vector<Number>& a) const {
        Vector<Number> b;
        for (int i = 0; i < 3; ++i) b.x[i] = r[3 * i] * a.x[0] + r[3 * i + 1] * a.x[1] + r[3 * i + 2] * a.x[2];
        return b;
    }
};

// A twist or a wrench about the origin.
template <class Number>
struct Screw {
    Vector<Number> turn, shift;
};

template <class Number>
void multiply_turns(Number* out, const Number* a, const Number* b) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

template <class Number>
void multiply(Frame<Number>& out, const Frame<Number>& a, const Frame<Number>& b) {
    multiply_turns(out.r, a.r, b.r);
    for (int i = 0; i < 3; ++i)
        out.p[i] = a.r[3 * i] * b.p[0] + a.r[3 * i + 1] * b.p[1] + a.r[3 * i + 2] * b.p[2] + a.p[i];
}

// From a matrix [4, 4].
template <class Number>
Frame<Number> read_frame(const Number* matrix) {
    Frame<Number> f;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) f.r[3 * i + j] = matrix[4 * i + j];
        f.p[i] = matrix[4 * i + 3];
    }
    return f;
}

template <class Number>
void write_frame(const Frame<Number>& f, Number* matrix) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) matrix[4 * i + j] = f.r[3 * i + j];
        matrix[4 * i + 3] = f.p[i];
        matrix[12 + i] = Number{};
    }
    matrix[15] = Number{1};
}

// --- turns -------------------------------------------------------------------------------------------------------------

template <class Number>
struct Circle {
    Number cosine, sine;
};

inline Circle<double> circle(double angle) {
    const motion::Complex unit = motion::unit_vector(angle);
    return {unit.x, unit.y};
}

inline Circle<Complex> circle(Complex angle) {
    const motion::Complex real = motion::unit_vector(angle.re);
    const double up = std::exp(angle.im), down = 1 / up, cosh = (up + down) / 2, sinh = (up - down) / 2;
    return {{real.x * cosh, -(real.y * sinh)}, {real.y * cosh, real.x * sinh}};
}

// A rotation by a turn about an axis, applied from the right.
template <class Number>
void turn_about(Number* r, int axis, const Circle<Number>& k) {
    const int a = axis == 2 ? 0 : axis + 1, b = axis == 0 ? 2 : axis - 1;
    for (int i = 0; i < 3; ++i) {
        const Number first = r[3 * i + a], second = r[3 * i + b];
        r[3 * i + a] = k.cosine * first + k.sine * second;
        r[3 * i + b] = k.cosine * second - k.sine * first;
    }
}

// A step of Newton and Schulz towards the next rotation.
template <class Number>
void make_orthogonal(Number* r) {
    Number square[9], out[9];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            square[3 * i + j] = r[i] * r[j] + r[3 + i] * r[3 + j] + r[6 + i] * r[6 + j];  // transposed r times r
    multiply_turns(out, r, square);
    for (int i = 0; i < 9; ++i) r[i] = 1.5 * r[i] - 0.5 * out[i];
}

// --- trees -------------------------------------------------------------------------------------------------------------

// Frames of the nodes, and the screws of those that move, by a unit of their value.
template <class Number>
class Tree {
public:
    Tree(const Structure& of, const double* pitches)
        : structure(of),
          still(static_cast<std::size_t>(of.nodes)),
          given(static_cast<std::size_t>(of.nodes)),
          turns(static_cast<std::size_t>(of.balls) * turn_size),
          settled(static_cast<std::size_t>(of.nodes)),
          frames_(static_cast<std::size_t>(of.nodes)),
          screws_(static_cast<std::size_t>(of.nodes)),
          pitches_(pitches) {}

    Structure structure;
    std::vector<Frame<Number>> still;  // of the nodes that stand still
    std::vector<Number> given;         // values that are no unknowns
    std::vector<Number> turns;         // where the turns of balls are counted from, [balls, 3, 3]
    std::vector<char> settled;         // whether the frame of a node is there for good

    const Frame<Number>& frame(int node) const { return frames_[static_cast<std::size_t>(node)]; }
    const Screw<Number>& screw(int node) const { return screws_[static_cast<std::size_t>(node)]; }
    Screw<Number>& screw(int node) { return screws_[static_cast<std::size_t>(node)]; }

    // The nodes from the first on, up to the last.
    void move(const Number* q, int first, int last) {
        for (int k = first; k < last; ++k) {
            const std::int64_t* own = structure.node_at(k);
            const Kind kind = static_cast<Kind>(own[1]);
            if (settled[static_cast<std::size_t>(k)]) continue;
            Frame<Number>& f = frames_[static_cast<std::size_t>(k)];
            if (kind == Kind::still) {
                const Frame<Number>& at = still[static_cast<std::size_t>(k)];
                if (own[0] >= 0)
                    multiply(f, frame(static_cast<int>(own[0])), at);
                else
                    f = at;
                continue;
            }
            f = frame(static_cast<int>(own[0]));
            if (own[5] >= 0) multiply_turns(f.r, frame(static_cast<int>(own[0])).r, turns.data() + own[5] * turn_size);
            const double sign = static_cast<double>(own[3]);
            const Number value = sign * (own[4] >= 0 ? q[own[4]] : given[static_cast<std::size_t>(k)]);
            const int axis = static_cast<int>(own[2]);
            const Vector<Number> along = f.axis(axis);
            Screw<Number>& s = screws_[static_cast<std::size_t>(k)];
            const double pitch = kind == Kind::screws ? pitches_[k] : kind == Kind::shifts ? 1 : 0;
            for (int i = 0; i < 3; ++i) s.shift.x[i] = sign * pitch * along.x[i];
            s.turn = {};
            if (kind != Kind::shifts) {
                for (int i = 0; i < 3; ++i) s.turn.x[i] = sign * along.x[i];
                s.shift = s.shift + cross(f.origin(), s.turn);
                turn_about(f.r, axis, circle(value));
            }
            if (kind != Kind::turns)
                for (int i = 0; i < 3; ++i) f.p[i] = f.p[i] + pitch * (value * along.x[i]);
        }
    }

    // Counts the turns of a ball from where its three nodes, the first of which is given, have these values.
    void count_from(int node, const Number* values) {
        Number* rotation = turns.data() + structure.node_at(node)[5] * turn_size;
        for (int i = 0; i < 3; ++i) {
            const std::int64_t* own = structure.node_at(node + i);
            turn_about(rotation, static_cast<int>(own[2]), circle(static_cast<double>(own[3]) * values[i]));
        }
        make_orthogonal(rotation);
    }

private:
    std::vector<Frame<Number>> frames_;
    std::vector<Screw<Number>> screws_;
    const double* pitches_;
};

// --- rows --------------------------------------------------------------------------------------------------------------

// By how much a row is open, and the wrench whose product with the twist of the second frame against the first is its rate.
template <class Number>
struct Opening {
    Number value;
    Screw<Number> wrench;  // `turn` is the moment, `shift` the force
};

// Of a length half of the difference of the squares.
template <class Number>
Opening<Number> opening(const std::int64_t* row, const Frame<Number>& first, const Frame<Number>& second, Number length) {
    const Vector<Number> u = first.axis(static_cast<int>(row[3])), gap = second.origin() - first.origin();
    switch (static_cast<RowKind>(row[0])) {
        case RowKind::across: {
            const Vector<Number> v = second.axis(static_cast<int>(row[4]));
            return {dot(u, v), {cross(v, u), {}}};
        }
        case RowKind::offset: return {dot(u, gap), {cross(second.origin(), u), u}};
        case RowKind::length: break;
    }
    return {0.5 * (dot(gap, gap) - length * length), {cross(second.origin(), gap), gap}};
}

// Of a row: a node between its frames, that moves the second one, or, with the sign -1, the first.
struct Part {
    int node;
    double sign;
};

inline std::vector<std::vector<Part>> parts_between(const Structure& structure) {
    std::vector<std::vector<Part>> between(static_cast<std::size_t>(structure.rows));
    for (int row = 0; row < structure.rows; ++row) {
        std::vector<double> side(static_cast<std::size_t>(structure.nodes), 0);
        const std::int64_t* ask = structure.row_at(row);
        for (auto k = ask[2]; k >= 0; k = structure.node_at(static_cast<int>(k))[0]) side[static_cast<std::size_t>(k)] += 1;
        for (auto k = ask[1]; k >= 0; k = structure.node_at(static_cast<int>(k))[0]) side[static_cast<std::size_t>(k)] -= 1;
        for (int k = 0; k < structure.nodes; ++k)
            if (side[static_cast<std::size_t>(k)] != 0)
                between[static_cast<std::size_t>(row)].push_back({k, side[static_cast<std::size_t>(k)]});
    }
    return between;
}

template <class Number>
Number work_of(const Screw<Number>& wrench, const Screw<Number>& twist) {
    return dot(wrench.turn, twist.turn) + dot(wrench.shift, twist.shift);
}

}  // namespace gruebler::space
