#include "layout/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gruebler::layout {
namespace {

constexpr double least_square = 1e-24;  // of a distance, so that energies are numbers
constexpr double three = 3;             // points share a distance: none passes its segment
constexpr double first_length = 0.05, longer = 1.3, shorter = 0.4;  // a step; after success, after failure
constexpr double shortest = 1e-14;      // a step of rounding: the energy falls no more
constexpr double momentum = 0.8;        // the part of the last step that is kept
constexpr double settled = 1e-7;        // a step that lowers the energy by less, relative, is the last one
constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr std::int64_t work_of_a_pair = 4;  // in the steps of the watch

Point operator+(Point p, Point q) { return {p.x + q.x, p.y + q.y}; }
Point operator-(Point p, Point q) { return {p.x - q.x, p.y - q.y}; }
Point operator*(double k, Point p) { return {k * p.x, k * p.y}; }
void operator+=(Point& p, Point q) { p = p + q; }
void operator-=(Point& p, Point q) { p = p - q; }
double dot(Point p, Point q) { return p.x * q.x + p.y * q.y; }
double cross(Point p, Point q) { return p.x * q.y - p.y * q.x; }

// The place on a segment that is nearest to a point, 0 at its start and 1 at its end, and the vector from there.
struct Offset {
    double place;
    Point vector;
};

Offset offset(Point start, Point end, Point point) {
    const Point along = end - start, away = point - start;
    const double square = dot(along, along);
    const double place = square == 0 ? 0 : std::clamp(dot(along, away) / square, 0.0, 1.0);
    return {place, away - place * along};
}

// d^-power from d^2.
double inverse_power(double square, int power) {
    double product = 1;
    for (int k = 0; k < power; k += 2) product *= square;
    return 1 / product;
}

// A layout with what its energy says.
struct State {
    std::vector<Point> place;
    std::vector<Point> slope;  // the gradient of the energy
    std::vector<double> room;  // how far each point may go
    double energy = 0;

    explicit State(std::int64_t points) : place(points), slope(points), room(points) {}

    void measure(const Drawing& drawing, int power) {
        std::fill(slope.begin(), slope.end(), Point{});
        std::fill(room.begin(), room.end(), infinity);
        energy = 0;
        for (std::int64_t k = 0; k < drawing.segments; ++k) {
            const auto [a, b] = drawing.segment[k];
            const double pull = drawing.pull[k];
            const Point along = place[b] - place[a];
            energy += pull * dot(along, along);
            slope[a] -= 2 * pull * along;
            slope[b] += 2 * pull * along;
        }
        for (std::int64_t k = 0; k < drawing.watched; ++k) {
            const auto [number, p] = drawing.pair[k];
            const auto [a, b] = drawing.segment[number];
            const auto [t, away] = offset(place[a], place[b], place[p]);
            const double square = std::max(dot(away, away), least_square);
            const double step = std::sqrt(square) / three;
            for (const std::int64_t point : {a, b, p}) room[point] = std::min(room[point], step);
            const double value = inverse_power(square, power);
            energy += value;
            const Point push = power * value / square * away;
            slope[p] -= push;
            slope[a] += (1 - t) * push;
            slope[b] += t * push;
        }
    }
};

// The mean of a layout over the symmetries.
void symmetrise(const Drawing& drawing, const std::vector<Point>& place, std::vector<Point>& mean) {
    std::fill(mean.begin(), mean.end(), Point{});
    for (std::int64_t g = 0; g < drawing.symmetries; ++g) {
        const Turn& turn = drawing.turn[g];
        const std::int64_t* image = drawing.image + g * drawing.points;
        for (std::int64_t p = 0; p < drawing.points; ++p) {
            const Point q = place[image[p]];
            mean[p] += Point{turn.xx * q.x + turn.yx * q.y, turn.xy * q.x + turn.yy * q.y};
        }
    }
    for (Point& p : mean) p = {p.x / drawing.symmetries, p.y / drawing.symmetries};
}

}  // namespace

Relaxed relax(const Drawing& drawing, int power, std::int64_t rounds, Point* layout, Watch& watch) {
    const std::int64_t terms = drawing.watched + drawing.segments + drawing.points * drawing.symmetries;
    const std::int64_t work = work_of_a_pair * terms;
    State now(drawing.points), trial(drawing.points);
    std::vector<Point> move(drawing.points), mean(drawing.points);
    std::copy(layout, layout + drawing.points, now.place.begin());
    now.measure(drawing, power);
    double length = first_length, keep = 0;
    for (std::int64_t round = 0; round < rounds; ++round) {
        if (!spend(watch, work)) return {false, now.energy};
        for (std::int64_t p = 0; p < drawing.points; ++p) {
            move[p] = keep * move[p] - length * now.slope[p];
            const double size = std::sqrt(dot(move[p], move[p]));
            if (size > now.room[p]) move[p] = now.room[p] / size * move[p];
            trial.place[p] = now.place[p] + move[p];
        }
        if (drawing.symmetries > 1) {
            symmetrise(drawing, trial.place, mean);
            std::swap(trial.place, mean);
        }
        trial.measure(drawing, power);
        if (trial.energy <= now.energy) {
            const bool done = now.energy - trial.energy <= settled * trial.energy && keep > 0;
            std::swap(now, trial);
            length *= longer;
            keep = momentum;
            if (done) break;
        } else {
            std::fill(move.begin(), move.end(), Point{});
            keep = 0;
            length *= shorter;
            if (length < shortest) break;
        }
    }
    std::copy(now.place.begin(), now.place.end(), layout);
    return {true, now.energy};
}

double closest(const Drawing& drawing, const Point* layout) {
    double least = infinity;
    for (std::int64_t k = 0; k < drawing.watched; ++k) {
        const auto [number, p] = drawing.pair[k];
        const auto [a, b] = drawing.segment[number];
        const Point away = offset(layout[a], layout[b], layout[p]).vector;
        least = std::min(least, dot(away, away));
    }
    return std::sqrt(least);
}

bool crossing_segments(const Drawing& drawing, const Point* layout, std::vector<Segment>& pairs, Watch& watch) {
    const auto side = [layout](std::int64_t a, std::int64_t b, std::int64_t c) {
        return cross(layout[b] - layout[a], layout[c] - layout[a]);
    };
    for (std::int64_t i = 0; i < drawing.segments; ++i) {
        if (!spend(watch, i)) return false;
        const auto [a, b] = drawing.segment[i];
        for (std::int64_t j = 0; j < i; ++j) {
            const auto [c, d] = drawing.segment[j];
            if (a == c || a == d || b == c || b == d) continue;
            if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) pairs.push_back({j, i});
        }
    }
    return true;
}

}  // namespace gruebler::layout
