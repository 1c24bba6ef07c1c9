#include "space/rods.hpp"

#include <cmath>

namespace gruebler::space {
namespace {

using Place = Vector<double>;

constexpr int most_terms = 4;
constexpr double opposite = 0.03;  // radians: the nearer, the faster the shortest turn spins, and the fewer digits its rates have

Place read(const double* x) { return {{x[0], x[1], x[2]}}; }

// The half turn about a direction: 2 u u^T / u² - 1.
void half_turn(const Place& u, double* r) {
    const double share = 2 / dot(u, u);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) r[3 * i + j] = share * (u.x[i] * u.x[j]) - (i == j);
}

}  // namespace

void place_rod(const double* vectors, const Frame<double>* first, const Frame<double>* second, Frame<double>* rod,
               int orders) {
    const Place on_first = read(vectors), on_second = read(vectors + 3), a = read(vectors + 6), b = read(vectors + 9);
    const Place along = b - a;
    const double length = std::sqrt(dot(along, along));
    const Place u = 1 / length * along;
    Place begin[most_terms], s[most_terms];
    for (int k = 0; k <= orders; ++k) {
        begin[k] = first[k].origin() + first[k].turned(on_first);
        s[k] = 1 / length * (second[k].origin() + second[k].turned(on_second) - begin[k]);
    }
    double before[9], turn[9];
    half_turn(u, before);
    const Place sum = u + s[0];
    if (dot(sum, sum) < opposite * opposite) {
        const Place across = read(vectors + 12);
        half_turn(u + across, turn);
        double other[9];
        multiply_turns(other, turn, before);
        half_turn(across, turn);
        multiply_turns(before, turn, other);
        s[0] = s[0] + across;
    } else {
        s[0] = sum;
    }
    // 2 s s^T / s², with 1 / s² as a series.
    double square[most_terms], inverse[most_terms];
    for (int k = 0; k <= orders; ++k) {
        square[k] = 0;
        for (int i = 0; i <= k; ++i) square[k] += dot(s[i], s[k - i]);
        double left = k == 0;
        for (int i = 1; i <= k; ++i) left -= square[i] * inverse[k - i];
        inverse[k] = left / square[0];
        double half[9] = {};
        for (int i = 0; i <= k; ++i)
            for (int j = 0; i + j <= k; ++j) {
                const double share = 2 * inverse[k - i - j];
                for (int m = 0; m < 9; ++m) half[m] += share * (s[i].x[m / 3] * s[j].x[m % 3]);
            }
        for (int i = 0; k == 0 && i < 3; ++i) half[4 * i] -= 1;
        multiply_turns(rod[k].r, half, before);
        const Place origin = begin[k] - rod[k].turned(a);
        for (int i = 0; i < 3; ++i) rod[k].p[i] = origin.x[i];
    }
}

}  // namespace gruebler::space
