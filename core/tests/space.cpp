// Modes and motions in space without Python, for sanitizers: a hand that turns by the law of cosines, a body on a ball
// whose points end at the distances that were asked for, a body on a ball that a crank turns round, a screw, wheels,
// numbers that are none, and work that is ended.
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "check.hpp"
#include "space/following.hpp"
#include "space/modes.hpp"

using namespace gruebler;
using namespace gruebler::space;

namespace {

constexpr std::int64_t still = 0, turns = 1, shifts = 2, screws = 3, offset = 0, length = 2, none = -1;

struct Point {
    double x, y, z;
};

// A linkage with all that its paths need, nodes that stand still shifted so far from their parents.
struct Dimensioned {
    std::vector<std::int64_t> nodes, rows;
    std::vector<Complex> frames, twists, lengths, given;

    Dimensioned(std::vector<std::int64_t> all_nodes, std::vector<std::int64_t> all_rows, const std::vector<Point>& shifts)
        : nodes(all_nodes),
          rows(all_rows),
          frames(shifts.size() * frame_size),
          twists(shifts.size() * twist_size),
          lengths(2 * all_rows.size() / row_fields),
          given(2 * shifts.size()) {
        for (std::size_t k = 0; k < shifts.size(); ++k) {
            Complex* frame = frames.data() + k * frame_size;
            for (int i = 0; i < 4; ++i) frame[5 * i] = {1, 0};
            frame[3] = {shifts[k].x, 0}, frame[7] = {shifts[k].y, 0}, frame[11] = {shifts[k].z, 0};
        }
    }
};

struct Ends {
    bool done;
    std::vector<Complex> at, turns, frames;
    std::vector<double> times;
    std::vector<std::int64_t> steps;

    Point place(int node) const {
        const Complex* frame = frames.data() + node * frame_size;
        return {frame[3].re, frame[7].re, frame[11].re};
    }
};

Ends follow_all(const Dimensioned& linkage, const std::vector<Complex>& starts, const std::vector<Complex>& balls,
                std::size_t count, Watch& watch) {
    const std::size_t nodes = linkage.given.size() / 2, unknowns = linkage.lengths.size() / 2;
    Ends ends{false,
              starts,
              balls,
              std::vector<Complex>(count * nodes * frame_size),
              std::vector<double>(count),
              std::vector<std::int64_t>(count)};
    const Structure structure{static_cast<int>(nodes),    static_cast<int>(unknowns),
                              static_cast<int>(unknowns), static_cast<int>(balls.size() / count / turn_size),
                              linkage.nodes.data(),       linkage.rows.data()};
    const Way way{linkage.frames.data(), linkage.twists.data(), linkage.lengths.data(), linkage.given.data()};
    const Paths paths{static_cast<std::int64_t>(count),
                      starts.data(),
                      balls.data(),
                      1e-3,
                      ends.at.data(),
                      ends.turns.data(),
                      ends.frames.data(),
                      ends.times.data(),
                      ends.steps.data()};
    ends.done = follow(structure, way, paths, watch);
    return ends;
}

double distance(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

struct Driven {
    bool done;
    Followed followed;
    std::vector<double> unknowns, poses;
};

// The first unknown is the drive, of speed 1 and acceleration and jerk 0; all others follow.
Driven drive(const Dimensioned& of, const std::vector<double>& lengths, const std::vector<double>& pitches,
             const std::vector<double>& gears, int unknowns, int balls, const std::vector<std::int64_t>& links,
             const std::vector<double>& values, Watch& watch) {
    std::vector<double> frames;
    for (const Complex& entry : of.frames) frames.push_back(entry.re);
    const int nodes = static_cast<int>(pitches.size()), rows = static_cast<int>(of.rows.size() / row_fields);
    const int wheels = static_cast<int>(gears.size()) / unknowns, orders = 3;
    const Structure structure{nodes, rows, unknowns, balls, of.nodes.data(), of.rows.data()};
    const Linkage linkage{structure, frames.data(), pitches.data(), lengths.data(), gears.data(), wheels};
    std::vector<std::int64_t> passive;
    for (int k = 1; k < unknowns; ++k) passive.push_back(k);
    const std::int64_t first = 0;
    const std::size_t many = values.size();
    std::vector<double> rates(many * orders), derivatives(many * static_cast<std::size_t>((rows + wheels) * unknowns));
    std::vector<std::uint8_t> passed(many);
    for (std::size_t row = 0; row < many; ++row) rates[row] = 1;
    std::vector<double> start(static_cast<std::size_t>(unknowns)), turns;
    for (int ball = 0; ball < balls; ++ball) turns.insert(turns.end(), {1, 0, 0, 0, 1, 0, 0, 0, 1});
    Driven driven{};
    driven.unknowns.resize((orders + 1) * many * static_cast<std::size_t>(unknowns));
    driven.poses.resize((orders + 1) * many * links.size() * frame_size);
    // A rod between the points (1, 0, 0) of the links in front of and behind it, if it is one.
    const std::int64_t rod[] = {1, 0, 2};
    const double vectors[] = {1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 1}, unit[] = {1, 0, 0, 0};
    const Path path{static_cast<std::int64_t>(many), 1,
                    unknowns - 1,                    static_cast<int>(links.size()),
                    links.size() == 3,               orders,
                    &first,                          passive.data(),
                    links.data(),                    rod,
                    vectors,                         unit,
                    start.data(),                    turns.data(),
                    values.data(),                   rates.data(),
                    driven.unknowns.data(),          driven.poses.data(),
                    derivatives.data(),              passed.data()};
    driven.done = follow(linkage, path, driven.followed, watch);
    return driven;
}

// A crank turns about z; a body on a ball at the same place is tied to it by three rods, and so turns as it does.
void check_motions(Watch& watch) {
    const std::vector<Point> places{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0},
                                    {1, 0, 0}, {0, 1, 0}, {2, 1, 1}, {1, -1, 2}};
    const Dimensioned round({-1, still, 0, 1, none, none, 0, turns, 2, 1, 0,    none, 0, turns, 0, 1, 1,    0,
                             2,  turns, 1, 1, 2,    none, 3, turns, 2, 1, 3,    none, 4, still, 0, 1, none, none,
                             4,  still, 0, 1, none, none, 1, still, 0, 1, none, none, 1, still, 0, 1, none, none},
                            {length, 5, 7, 0, 0, length, 5, 8, 0, 0, length, 6, 7, 0, 0}, places);
    const std::vector<double> lengths{distance(places[5], places[7]), distance(places[5], places[8]),
                                      distance(places[6], places[7])};
    const std::vector<double> turned{0, 1.3, 2.6, 3.9, 5.2};
    const Driven body = drive(round, lengths, std::vector<double>(9), {}, 4, 1, {4, -1, 0}, turned, watch);
    expect(body.done && body.followed.rows == 5 && body.followed.gap < 1e-12, "the ball did not go round");
    for (std::size_t row = 0; row < 5; ++row) {
        const double c = std::cos(turned[row]), s = std::sin(turned[row]);
        const double rates[4][2] = {{c, s}, {-s, c}, {-c, -s}, {s, -c}};
        for (std::size_t order = 0; order < 4; ++order) {
            const double* pose = body.poses.data() + (order * 5 + row) * 3 * frame_size;
            expect(std::abs(pose[0] - rates[order][0]) < 1e-11 && std::abs(pose[4] - rates[order][1]) < 1e-11,
                   "the body does not turn as the crank does");
        }
    }

    // A spindle with the pitch 0.5, its nut held by a slide, and a wheel three times as large beside it.
    const Dimensioned spindle({-1, still, 0, 1, none, none, 0, screws, 2, 1, 0, none, 0, shifts, 2, 1, 1, none,
                               0, turns, 2, 1, 2, none},
                              {offset, 1, 2, 2, 0}, std::vector<Point>(4));
    const Driven nut = drive(spindle, {0}, {0, 0.5, 0, 0}, {1, 0, 3}, 3, 0, {2}, {0.5, 40}, watch);
    expect(nut.done && nut.followed.rows == 2 && std::abs(nut.unknowns[3 + 1] - 20) < 1e-11 &&
               std::abs(nut.unknowns[3 + 2] + 40.0 / 3) < 1e-11 && std::abs(nut.unknowns[6 + 1] - 0.5) < 1e-12,
           "the nut or the wheel went elsewhere");

    // |(-sin q, cos q, 0) - (1 + h, 0, 0)| = sqrt 2 with the drive h, up to where the two lie in line, at sqrt 2.
    const Dimensioned rod({-1, still, 0, 1, none, none, 0, still, 0, 1, none, none, 1, shifts, 0, 1, 0, none,
                           0, turns, 2, 1, 1, none, 3, still, 0, 1, none, none},
                          {length, 2, 4, 0, 0}, {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 1, 0}});
    const std::vector<double> whole{std::sqrt(2.0)}, none_of_screws(5);
    const Driven limit = drive(rod, whole, none_of_screws, {}, 2, 0, {4}, {0, 0.3, 2.5, 3}, watch);
    expect(limit.done && limit.followed.rows == 2 && std::abs(limit.followed.part - (std::sqrt(2.0) - 0.3) / 2.2) < 1e-5,
           "the rod did not stop where it must");
    for (const double odd : {1e300, std::numeric_limits<double>::infinity(), std::nan("")})
        expect(drive(rod, whole, none_of_screws, {}, 2, 0, {4}, {odd}, watch).followed.rows == 0,
               "numbers that are none arrived");
    Watch tired{never, nullptr, 1};
    expect(!drive(rod, whole, none_of_screws, {}, 2, 0, {4}, {0.3}, tired).done, "nobody ended the motion");
}

}  // namespace

int main() {
    Watch watch{always, nullptr};
    check_motions(watch);
    const double quarter = std::acos(0.0);
    // |(cos q, sin q, 0) - (2, 0, 0)| from the root of 5 to 1.2.
    Dimensioned hand(
        {-1, still, 0, 1, none, none, 0, turns, 2, 1, 0, none, 1, still, 0, 1, none, none, 0, still, 0, 1, none, none},
        {length, 2, 3, 0, 0}, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    hand.lengths = {{std::sqrt(5.0), 0}, {1.2 - std::sqrt(5.0), 0}};
    const Ends found = follow_all(hand, {{quarter, 0}, {-quarter, 0}}, {}, 2, watch);
    const double angle = std::acos((1 + 4 - 1.44) / 4);
    expect(found.done && found.times[0] == 1 && found.times[1] == 1, "the hand did not arrive");
    expect(std::abs(found.at[0].re - angle) < 1e-13 && std::abs(found.at[1].re + angle) < 1e-13,
           "the hand ended elsewhere");

    // A body that turns about the origin, two of its points at three distances from two fixed ones.
    const std::vector<Point> places{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0},
                                    {1, 0, 0}, {0, 1, 0}, {2, 1, 1}, {1, -1, 2}};
    Dimensioned body({-1, still, 0,    1,     none, none,  0, turns, 0,    1,     0, 0,     1,    turns, 1,    1,
                  1,  none,  2,    turns, 2,    1,     2, none,  3,    still, 0, 1,     none, none,  3,    still,
                  0,  1,     none, none,  0,    still, 0, 1,     none, none,  0, still, 0,    1,     none, none},
                 {length, 4, 6, 0, 0, length, 4, 7, 0, 0, length, 5, 6, 0, 0}, places);
    const double before[] = {distance(places[4], places[6]), distance(places[4], places[7]),
                             distance(places[5], places[6])};
    const double change[] = {0.2, -0.3, 0.25};
    body.lengths.clear();
    for (const double each : before) body.lengths.push_back({each, 0});
    for (const double each : change) body.lengths.push_back({each, 0});
    const std::vector<Complex> unturned{{1, 0}, {0, 0}, {0, 0}, {0, 0}, {1, 0}, {0, 0}, {0, 0}, {0, 0}, {1, 0}};
    const Ends turned = follow_all(body, {{0, 0}, {0, 0}, {0, 0}}, unturned, 1, watch);
    expect(turned.done && turned.times[0] == 1, "the body did not arrive");
    const int pairs[][2] = {{4, 6}, {4, 7}, {5, 6}};
    for (int i = 0; i < 3; ++i)
        expect(std::abs(distance(turned.place(pairs[i][0]), turned.place(pairs[i][1])) - before[i] - change[i]) < 1e-12,
               "a point of the body is at another distance");
    expect(std::abs(distance(turned.place(4), {0, 0, 0}) - 1) < 1e-12 &&
               std::abs(distance(turned.place(4), turned.place(5)) - std::sqrt(2.0)) < 1e-12,
           "the body is not rigid");

    for (const double odd : {1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
        const Ends lost = follow_all(body, {{odd, odd}, {0, 0}, {odd, 0}}, unturned, 1, watch);
        expect(lost.done && lost.times[0] < 1, "numbers that are none arrived");
    }
    Watch tired{never, nullptr, 1};
    expect(!follow_all(hand, {{quarter, 0}, {-quarter, 0}}, {}, 2, tired).done, "nobody ended the work");
    std::puts("space: all as it should be");
}
