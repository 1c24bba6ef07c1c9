#include "space/closing.hpp"

#include <cmath>

#include "motion/circle.hpp"

namespace gruebler::space {
namespace {

Vector operator+(const Vector& a, const Vector& b) { return {{a.x[0] + b.x[0], a.x[1] + b.x[1], a.x[2] + b.x[2]}}; }
Vector operator-(const Vector& a, const Vector& b) { return {{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}}; }
Vector operator*(Complex k, const Vector& a) { return {{k * a.x[0], k * a.x[1], k * a.x[2]}}; }
Complex dot(const Vector& a, const Vector& b) { return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2]; }
Vector cross(const Vector& a, const Vector& b) {
    return {{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}
Vector origin(const Frame& f) { return {{f.p[0], f.p[1], f.p[2]}}; }
Vector turned(const Frame& f, const Vector& a) {
    Vector b;
    for (int i = 0; i < 3; ++i) b.x[i] = f.r[3 * i] * a.x[0] + f.r[3 * i + 1] * a.x[1] + f.r[3 * i + 2] * a.x[2];
    return b;
}

struct Circle {
    Complex cosine, sine;
};

// Of a complex angle.
Circle circle(Complex angle) {
    const motion::Complex real = motion::unit_vector(angle.re);
    const double up = std::exp(angle.im), down = 1 / up, cosh = (up + down) / 2, sinh = (up - down) / 2;
    return {{real.x * cosh, -(real.y * sinh)}, {real.y * cosh, real.x * sinh}};
}

Complex square_root(Complex u) {
    const double r = algebra::modulus(u);
    if (r == 0) return {0, 0};
    const double big = std::sqrt((r + std::fabs(u.re)) / 2), small = u.im / (2 * big);
    return u.re >= 0 ? Complex{big, small} : Complex{std::fabs(small), u.im < 0 ? -big : big};
}

void multiply(Frame& out, const Frame& a, const Frame& b) {
    for (int i = 0; i < 3; ++i) {
        const Complex* row = a.r + 3 * i;
        for (int j = 0; j < 3; ++j) out.r[3 * i + j] = row[0] * b.r[j] + row[1] * b.r[3 + j] + row[2] * b.r[6 + j];
        out.p[i] = row[0] * b.p[0] + row[1] * b.p[1] + row[2] * b.p[2] + a.p[i];
    }
}

// exp of t times a twist: 1 + W sin r / r + W² (1 - cos r) / r², the functions of r² by series where that is small.
Frame exponential(const Complex* twist, double t) {
    const Vector w{{t * twist[0], t * twist[1], t * twist[2]}}, v{{t * twist[3], t * twist[4], t * twist[5]}};
    const Complex square = dot(w, w), one{1, 0};
    Complex a, b, c;  // sin r / r, (1 - cos r) / r², (r - sin r) / r³
    constexpr double small = 1e-4;
    if (algebra::size(square) < small) {
        a = one - (1.0 / 6) * square + (1.0 / 120) * (square * square);
        b = Complex{0.5, 0} - (1.0 / 24) * square + (1.0 / 720) * (square * square);
        c = Complex{1.0 / 6, 0} - (1.0 / 120) * square + (1.0 / 5040) * (square * square);
    } else {
        const Complex r = square_root(square);
        const Circle k = circle(r);
        a = k.sine / r, b = (one - k.cosine) / square, c = (r - k.sine) / (square * r);
    }
    Frame f;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) f.r[3 * i + j] = b * (w.x[i] * w.x[j]);
    for (int i = 0; i < 3; ++i) {
        f.r[4 * i] = f.r[4 * i] + one - b * square;
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        f.r[3 * i + j] = f.r[3 * i + j] - a * w.x[k];
        f.r[3 * j + i] = f.r[3 * j + i] + a * w.x[k];
    }
    const Vector once = cross(w, v), twice = cross(w, once), p = v + b * once + c * twice;
    for (int i = 0; i < 3; ++i) f.p[i] = p.x[i];
    return f;
}

void turn_about(Complex* r, int axis, Circle k) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (int i = 0; i < 3; ++i) {
        const Complex first = r[3 * i + a], second = r[3 * i + b];
        r[3 * i + a] = k.cosine * first + k.sine * second;
        r[3 * i + b] = k.cosine * second - k.sine * first;
    }
}

Frame read(const Complex* matrix) {
    Frame f;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) f.r[3 * i + j] = matrix[4 * i + j];
        f.p[i] = matrix[4 * i + 3];
    }
    return f;
}

}  // namespace

void turn_further(Complex* rotation, const Complex* angles) {
    for (int axis = 0; axis < 3; ++axis) turn_about(rotation, axis, circle(angles[axis]));
}

void make_orthogonal(Complex* r) {
    Complex square[9], out[9];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            square[3 * i + j] = r[i] * r[j] + r[3 + i] * r[3 + j] + r[6 + i] * r[6 + j];  // transposed r times r
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const Complex third = r[3 * i] * square[j] + r[3 * i + 1] * square[3 + j] + r[3 * i + 2] * square[6 + j];
            out[3 * i + j] = 1.5 * r[3 * i + j] - 0.5 * third;
        }
    for (int i = 0; i < 9; ++i) r[i] = out[i];
}

Closing::Closing(const Structure& structure, const Way& way) : structure_(structure), way_(way) {
    const auto nodes = static_cast<std::size_t>(structure.nodes), rows = static_cast<std::size_t>(structure.rows);
    const auto unknowns = static_cast<std::size_t>(structure.unknowns);
    turns.resize(static_cast<std::size_t>(structure.balls) * turn_size);
    values.resize(rows), derivatives.resize(rows * unknowns), rates.resize(rows);
    still_.resize(nodes), frames_.resize(nodes), screws_.resize(nodes), between_.resize(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::int64_t* ask = structure.row + row * row_fields;
        std::vector<double> side(nodes, 0);
        for (auto k = ask[2]; k >= 0; k = node(static_cast<int>(k))[0]) side[static_cast<std::size_t>(k)] += 1;
        for (auto k = ask[1]; k >= 0; k = node(static_cast<int>(k))[0]) side[static_cast<std::size_t>(k)] -= 1;
        for (std::size_t k = 0; k < nodes; ++k)
            if (side[k] != 0) between_[row].push_back({static_cast<int>(k), side[k]});
    }
}

void Closing::place_dimensions(double time) {
    if (time == time_) return;
    time_ = time;
    for (int k = 0; k < structure_.nodes; ++k) {
        if (static_cast<Kind>(node(k)[1]) != Kind::still) continue;
        Frame& f = still_[static_cast<std::size_t>(k)];
        multiply(f, read(way_.frames + k * frame_size), exponential(way_.twists + k * twist_size, time));
    }
}

// Frames of the nodes; their screws: of what moves by a unit of its value, of a dimension by the time.
void Closing::move(const Complex* q, double time) {
    place_dimensions(time);
    for (int k = 0; k < structure_.nodes; ++k) {
        const std::int64_t* own = node(k);
        const int axis = static_cast<int>(own[2]);
        Frame& f = frames_[static_cast<std::size_t>(k)];
        Screw& s = screws_[static_cast<std::size_t>(k)];
        const Kind kind = static_cast<Kind>(own[1]);
        if (kind == Kind::still) {
            if (own[0] >= 0)
                multiply(f, frames_[static_cast<std::size_t>(own[0])], still_[static_cast<std::size_t>(k)]);
            else
                f = still_[static_cast<std::size_t>(k)];
            const Complex* twist = way_.twists + k * twist_size;
            s.turn = turned(f, {{twist[0], twist[1], twist[2]}});
            s.shift = turned(f, {{twist[3], twist[4], twist[5]}}) + cross(origin(f), s.turn);
            continue;
        }
        f = frames_[static_cast<std::size_t>(own[0])];
        if (own[5] >= 0) {
            const Frame above = f;
            const Complex* from = turns.data() + own[5] * turn_size;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    f.r[3 * i + j] =
                        above.r[3 * i] * from[j] + above.r[3 * i + 1] * from[3 + j] + above.r[3 * i + 2] * from[6 + j];
        }
        const double sign = static_cast<double>(own[3]);
        const Complex value = sign * (own[4] >= 0 ? q[own[4]] : way_.given[k] + time * way_.given[structure_.nodes + k]);
        const Vector along = f.axis(axis), unit = Complex{sign, 0} * along;
        if (kind == Kind::turns) {
            turn_about(f.r, axis, circle(value));
            s = {unit, cross(origin(f), unit)};
        } else {
            for (int i = 0; i < 3; ++i) f.p[i] = f.p[i] + value * along.x[i];
            s = {{}, unit};
        }
    }
}

void Closing::close(int row, double time) {
    const std::int64_t* ask = structure_.row + row * row_fields;
    const Frame &first = frame(static_cast<int>(ask[1])), &second = frame(static_cast<int>(ask[2]));
    const auto r = static_cast<std::size_t>(row);
    const Vector u = first.axis(static_cast<int>(ask[3])), gap = origin(second) - origin(first);
    Vector force{}, moment;
    Complex rate{};
    switch (static_cast<RowKind>(ask[0])) {
        case RowKind::across: {
            const Vector v = second.axis(static_cast<int>(ask[4]));
            values[r] = dot(u, v);
            moment = cross(v, u);
            break;
        }
        case RowKind::offset:
            values[r] = dot(u, gap);
            force = u;
            moment = cross(origin(second), u);
            break;
        case RowKind::length: {
            const Complex change = way_.lengths[structure_.rows + row], length = way_.lengths[row] + time * change;
            values[r] = 0.5 * (dot(gap, gap) - length * length);
            rate = -(length * change);
            force = gap;
            moment = cross(origin(second), gap);
            break;
        }
    }
    Complex* derivative = derivatives.data() + r * static_cast<std::size_t>(structure_.unknowns);
    for (int i = 0; i < structure_.unknowns; ++i) derivative[i] = {0, 0};
    for (const Part& part : between_[r]) {
        const std::int64_t* own = node(part.node);
        const Screw& s = screws_[static_cast<std::size_t>(part.node)];
        const Complex work = part.sign * (dot(moment, s.turn) + dot(force, s.shift));
        if (own[4] >= 0)
            derivative[own[4]] = derivative[own[4]] + work;
        else if (static_cast<Kind>(own[1]) == Kind::still)
            rate = rate + work;
        else
            rate = rate + way_.given[structure_.nodes + part.node] * work;
    }
    rates[r] = rate;
}

void Closing::evaluate(const Complex* q, double time) {
    move(q, time);
    for (int row = 0; row < structure_.rows; ++row) close(row, time);
}

bool Closing::solve(std::vector<Complex>& right) {
    const int n = structure_.unknowns;
    const auto row = [&](int i) { return derivatives.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(n); };
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int i = k + 1; i < n; ++i)
            if (algebra::size(row(i)[k]) > algebra::size(row(pivot)[k])) pivot = i;
        if (!(algebra::size(row(pivot)[k]) > 0)) return false;
        if (pivot != k) {
            for (int j = k; j < n; ++j) std::swap(row(k)[j], row(pivot)[j]);
            std::swap(right[static_cast<std::size_t>(k)], right[static_cast<std::size_t>(pivot)]);
        }
        for (int i = k + 1; i < n; ++i) {
            const Complex factor = row(i)[k] / row(k)[k];
            for (int j = k + 1; j < n; ++j) row(i)[j] = row(i)[j] - factor * row(k)[j];
            right[static_cast<std::size_t>(i)] = right[static_cast<std::size_t>(i)] - factor * right[static_cast<std::size_t>(k)];
        }
    }
    for (int k = n; k-- > 0;) {
        Complex sum = right[static_cast<std::size_t>(k)];
        for (int j = k + 1; j < n; ++j) sum = sum - row(k)[j] * right[static_cast<std::size_t>(j)];
        right[static_cast<std::size_t>(k)] = sum / row(k)[k];
    }
    return true;
}

}  // namespace gruebler::space
