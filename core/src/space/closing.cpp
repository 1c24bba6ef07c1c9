#include "space/closing.hpp"

#include <cmath>

namespace gruebler::space {
namespace {

Complex square_root(Complex u) {
    const double r = algebra::modulus(u);
    if (r == 0) return {0, 0};
    const double big = std::sqrt((r + std::fabs(u.re)) / 2), small = u.im / (2 * big);
    return u.re >= 0 ? Complex{big, small} : Complex{std::fabs(small), u.im < 0 ? -big : big};
}

// exp of t times a twist: 1 + W sin r / r + W² (1 - cos r) / r², the functions of r² by series where that is small.
Frame<Complex> exponential(const Complex* twist, double t) {
    const Vector<Complex> w{{t * twist[0], t * twist[1], t * twist[2]}}, v{{t * twist[3], t * twist[4], t * twist[5]}};
    const Complex square = dot(w, w), one{1, 0};
    Complex a, b, c;  // sin r / r, (1 - cos r) / r², (r - sin r) / r³
    constexpr double small = 1e-4;
    if (algebra::size(square) < small) {
        a = one - (1.0 / 6) * square + (1.0 / 120) * (square * square);
        b = Complex{0.5, 0} - (1.0 / 24) * square + (1.0 / 720) * (square * square);
        c = Complex{1.0 / 6, 0} - (1.0 / 120) * square + (1.0 / 5040) * (square * square);
    } else {
        const Complex r = square_root(square);
        const Circle<Complex> k = circle(r);
        a = k.sine / r, b = (one - k.cosine) / square, c = (r - k.sine) / (square * r);
    }
    Frame<Complex> f;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) f.r[3 * i + j] = b * (w.x[i] * w.x[j]);
    for (int i = 0; i < 3; ++i) {
        f.r[4 * i] = f.r[4 * i] + one - b * square;
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        f.r[3 * i + j] = f.r[3 * i + j] - a * w.x[k];
        f.r[3 * j + i] = f.r[3 * j + i] + a * w.x[k];
    }
    const Vector<Complex> once = cross(w, v), twice = cross(w, once), p = v + b * once + c * twice;
    for (int i = 0; i < 3; ++i) f.p[i] = p.x[i];
    return f;
}

}  // namespace

Closing::Closing(const Structure& structure, const Way& way)
    : Tree(structure, nullptr), way_(way), between_(parts_between(structure)) {
    const auto rows = static_cast<std::size_t>(structure.rows), unknowns = static_cast<std::size_t>(structure.unknowns);
    values.resize(rows), derivatives.resize(rows * unknowns), rates.resize(rows);
}

void Closing::place_dimensions(double time) {
    if (time == time_) return;
    time_ = time;
    for (int k = 0; k < structure.nodes; ++k) {
        const auto at = static_cast<std::size_t>(k);
        if (static_cast<Kind>(structure.node_at(k)[1]) == Kind::still)
            multiply(still[at], read_frame(way_.frames + k * frame_size), exponential(way_.twists + k * twist_size, time));
        else
            given[at] = way_.given[k] + time * way_.given[structure.nodes + k];
    }
}

void Closing::close(int row, double time) {
    const std::int64_t* ask = structure.row_at(row);
    const auto r = static_cast<std::size_t>(row);
    const Complex change = way_.lengths[structure.rows + row], length = way_.lengths[row] + time * change;
    const Opening<Complex> open = opening(ask, frame(static_cast<int>(ask[1])), frame(static_cast<int>(ask[2])), length);
    values[r] = open.value;
    Complex rate = static_cast<RowKind>(ask[0]) == RowKind::length ? -(length * change) : Complex{};
    Complex* derivative = derivatives.data() + r * static_cast<std::size_t>(structure.unknowns);
    for (int i = 0; i < structure.unknowns; ++i) derivative[i] = {0, 0};
    for (const Part& part : between_[r]) {
        const std::int64_t* own = structure.node_at(part.node);
        const Complex work = part.sign * work_of(open.wrench, screw(part.node));
        if (own[4] >= 0)
            derivative[own[4]] = derivative[own[4]] + work;
        else if (static_cast<Kind>(own[1]) == Kind::still)
            rate = rate + work;
        else
            rate = rate + way_.given[structure.nodes + part.node] * work;
    }
    rates[r] = rate;
}

void Closing::evaluate(const Complex* q, double time) {
    place_dimensions(time);
    move(q, 0, structure.nodes);
    for (int k = 0; k < structure.nodes; ++k) {  // the screws of dimensions, by the time
        if (static_cast<Kind>(structure.node_at(k)[1]) != Kind::still) continue;
        const Complex* twist = way_.twists + k * twist_size;
        Screw<Complex>& s = screw(k);
        s.turn = frame(k).turned({{twist[0], twist[1], twist[2]}});
        s.shift = frame(k).turned({{twist[3], twist[4], twist[5]}}) + cross(frame(k).origin(), s.turn);
    }
    for (int row = 0; row < structure.rows; ++row) close(row, time);
}

bool Closing::solve(std::vector<Complex>& right) {
    const int n = structure.unknowns;
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
