// The motion kernels without Python, for sanitizers: a four-bar over two turns against its closure, its limit, the same by its
// larger group, a slider-crank, and what is wrong with wrong programs.
#include <cmath>
#include <cstdio>
#include <vector>

#include "check.hpp"
#include "motion/designs.hpp"
#include "motion/inverses.hpp"
#include "motion/tracing.hpp"
#include "motion/walk.hpp"

using namespace gruebler;
using namespace gruebler::motion;

namespace {

// Links: 0 frame, 1 crank, 2 coupler, 3 rocker or slide; elements: the two sides of each joint in turn.
struct Machine {
    std::vector<std::int64_t> operations, links{0, 1, 1, 2, 2, 3, 0, 3};
    std::vector<Complex> points, lines = std::vector<Complex>(8, Complex{1, 0});
    std::vector<std::int64_t> conditions{0}, kinds, sides, owners, bodies{0}, roots, windings;
    std::vector<double> most{0.1}, values;
    std::int64_t dyads = 1, unknowns = 0;

    Program program() const {
        return {operations.data(), links.data(), points.data(), lines.data(), conditions.data(), kinds.data(),
                sides.data(), owners.data(), bodies.data(), roots.data(), most.data(), values.data(), windings.data(),
                {nullptr, 0, 14}, 4.0, static_cast<std::int64_t>(operations.size()) / 10,
                static_cast<std::int64_t>(links.size()), 4, 1, dyads, static_cast<std::int64_t>(conditions.size()) - 1,
                static_cast<std::int64_t>(kinds.size()), static_cast<std::int64_t>(roots.size()), unknowns};
    }
};

constexpr double a = 1, b = 3, c = 2.5, d = 3.2;

Machine four_bar() {
    Machine machine;
    machine.points = {{0, 0}, {0, 0}, {a, 0}, {0, 0}, {b, 0}, {c, 0}, {d, 0}, {0, 0}};
    machine.operations = {0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 2, 2, 3, 4, 5, 7, 6, 2, 3, 0};
    return machine;
}

Machine slider_crank() {
    Machine machine = four_bar();
    machine.points = {{0, 0}, {0, 0}, {a, 0}, {0, 0}, {b, 0}, {0, 0}, {0, 0.2}, {0, 0}};
    machine.operations[10] = 3;
    return machine;
}

// Coupler and rocker by Newton's method.
Machine group() {
    Machine machine = four_bar();
    machine.operations = {0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    machine.conditions = {0, 3};
    machine.kinds = {0, 0, 0};
    machine.sides = {2, 3, 4, 5, 6, 7};
    machine.owners = {-1, 0, 0, 1, -1, 1};
    machine.bodies = {0, 2};
    machine.roots = {2, 3};
    machine.windings = {-1, -1, -1};
    machine.values.assign(18, 0);
    machine.dyads = 0;
    machine.unknowns = 6;
    return machine;
}

struct Motion {
    std::vector<double> path, speeds, rates, roots, unknowns;
    std::vector<Complex> places, turns;
    std::vector<std::int32_t> whole;
    int order;
    std::int64_t rows;

    Motion(const Machine& machine, int derivatives, std::int64_t count, double step)
        : path(count), speeds(derivatives * count, 1.0), rates(derivatives * 4 * count), roots(machine.dyads * count),
          unknowns(machine.unknowns * count), places((derivatives + 1) * 4 * count), turns(4 * count), whole(4 * count),
          order(derivatives), rows(count) {
        for (std::int64_t row = 0; row < count; ++row) path[row] = 0.3 + step * static_cast<double>(row);
        for (int k = 1; k < derivatives; ++k)
            for (std::int64_t row = 0; row < count; ++row) speeds[k * count + row] = 0;
    }

    Path along() const { return {path.data(), speeds.data(), rows, 1, order}; }

    Poses poses(const Machine& machine) {
        return {places.data(), turns.data(), rates.data(), whole.data(), roots.data(), unknowns.data(), order, 4,
                static_cast<int>(machine.dyads), static_cast<int>(machine.unknowns), rows};
    }

    Outcome run(const Machine& machine, const std::vector<double>& start, bool (*goes_on)(void*) = always) {
        OwnPlan plan;
        const Program program = machine.program();
        expect(read_plan(program, plan).empty(), "a program is refused");
        Walk walk(plan.view(program), along(), poses(machine), baseline::sweep);
        const double sign = 1;
        Watch watch{goes_on, nullptr};
        return walk.follow(&sign, start.data(), watch);
    }

    Complex turn(int link, std::int64_t row) const { return turns[link * rows + row]; }
};

double length(Complex z) { return std::hypot(z.x, z.y); }

void check_four_bar(int order, double step) {
    const Machine machine = four_bar();
    Motion motion(machine, order, 1500, step);
    const Outcome outcome = motion.run(machine, {});
    expect(outcome.end == End::done && outcome.reached == 1500, "the four-bar stops");
    for (std::int64_t row = 0; row < 1500; ++row) {
        const Complex miss = a * motion.turn(1, row) + b * motion.turn(2, row) - c * motion.turn(3, row) - Complex{d, 0};
        expect(length(miss) < 1e-13, "the four-bar is open");
    }
    const double end = 0.3 + step * 1499;
    expect(motion.whole[2 * 1500 - 1] == static_cast<int>(std::floor((end + M_PI) / (2 * M_PI))), "whole turns");
}

void check_limit() {
    Machine machine = four_bar();
    machine.points[6] = {4.8, 0};  // a rocker now: the crank is the shortest no more able to turn round
    machine.points[2] = {2, 0};
    Motion motion(machine, 2, 2000, 0.002);
    const Outcome outcome = motion.run(machine, {});
    expect(outcome.end == End::limit, "a limit is passed");
    // Coupler and rocker in one line: the crank's end is b + c from the rocker's pivot.
    const double cosine = (4 + 4.8 * 4.8 - (b + c) * (b + c)) / (2 * 2 * 4.8);
    expect(std::fabs(0.3 + 0.002 * outcome.at - std::acos(cosine)) < 1e-9, "the limit is elsewhere");
}

void check_group() {
    const Machine dyad = four_bar(), machine = group();
    Motion known(dyad, 3, 60, 0.05), motion(machine, 3, 60, 0.05);
    expect(known.run(dyad, {}).end == End::done, "the four-bar stops");
    std::vector<double> start(6);
    for (int k = 0; k < 2; ++k) {
        const Complex place = known.places[(2 + k) * 60], turn = known.turn(2 + k, 0);
        start[3 * k] = place.x;
        start[3 * k + 1] = place.y;
        start[3 * k + 2] = std::atan2(turn.y, turn.x) + 0.01;
    }
    expect(motion.run(machine, start).end == End::done, "the larger group stops");
    for (std::size_t i = 0; i < known.rates.size(); ++i)
        expect(std::fabs(known.rates[i] - motion.rates[i]) < 1e-9, "rates of a dyad and of a larger group differ");
}

void check_slider_crank() {
    const Machine machine = slider_crank();
    Motion motion(machine, 3, 700, 0.01);
    expect(motion.run(machine, {}).end == End::done, "the slider-crank stops");
    for (std::int64_t row = 0; row < 700; ++row) {
        const Complex slide = motion.places[3 * 700 + row];
        expect(std::fabs(slide.y - 0.2) < 1e-14, "the slide leaves its line");
        expect(std::fabs(length(slide - a * motion.turn(1, row)) - b) < 1e-13, "the coupler has another length");
    }
}

void check_designs() {
    const Machine machine = four_bar();
    const Program program = machine.program();
    OwnPlan plan;
    expect(read_plan(program, plan).empty(), "a program is refused");
    Motion motion(machine, 1, 100, 0.02);
    std::vector<Complex> points, lines;
    for (int n = 0; n < 3; ++n) {
        points.insert(points.end(), machine.points.begin(), machine.points.end());
        lines.insert(lines.end(), machine.lines.begin(), machine.lines.end());
    }
    const std::vector<double> most(3, 0.1), sizes(3, 4), signs{1, NAN, -1};
    const std::vector<std::int64_t> kept{3};
    std::vector<Complex> places(2 * 3 * 100), turns(3 * 100);
    std::vector<double> rates(3 * 100);
    std::vector<std::int64_t> reached(3);
    Watch watch{always, nullptr};
    expect(move_designs(program, plan, motion.along(),
                        {points.data(), lines.data(), most.data(), sizes.data(), signs.data(), nullptr},
                        {places.data(), turns.data(), rates.data(), reached.data(), kept.data(), 3, 1, 1}, 0, 3,
                        baseline::sweep, watch),
           "designs are interrupted");
    expect(reached[0] == 100 && reached[1] == 0 && reached[2] == 100, "designs stop elsewhere");
    expect(std::isnan(turns[100].x) && std::fabs(length(turns[299]) - 1) < 1e-14, "what is written of designs");
}

void check_tracing() {
    // The four-bar without a drive, in its own size: crank, coupler, rocker.
    const int owners[] = {-1, 0, 0, 1, 1, 2, -1, 2};
    const Complex points[] = {{0, 0}, {0, 0}, {a, 0}, {0, 0}, {b, 0}, {c, 0}, {d, 0}, {0, 0}};
    std::vector<Condition> list;
    std::vector<ElementJet> sides(8);
    for (int e = 0; e < 8; ++e) {
        sides[e].point[0] = points[e];
        sides[e].line = {1, 0};
    }
    for (int k = 0; k < 4; ++k)
        list.push_back({Joint::pin, owners[2 * k], owners[2 * k + 1], none, 0, 0, 0, 0, 0, {0, 0, 0}});
    const Conditions conditions{list.data(), sides.data(), 4, {nullptr, 0, 14}, 1};
    Tracing tracing(conditions, 9);
    std::vector<double> arcs(400), poses(400 * 9), tangents(400 * 9), gauges(400);
    const double start[] = {0, 0, 0.3, std::cos(0.3), std::sin(0.3), 0.78, 3.2, 0, 1.5};
    for (int k = 0; k < 9; ++k) poses[k] = start[k], tangents[k] = 1;
    const Settled there = tracing.settle(poses.data(), tangents.data());
    expect(there.arrived && there.open < 1e-12 && there.rank == 8, "no pose on the curve");
    gauges[0] = there.gauge;
    Watch watch{always, nullptr};
    const Samples samples{arcs.data(), poses.data(), tangents.data(), gauges.data(), 400};
    const Trace trace = tracing.follow(samples, 1, 0.05, 0.2, 100, watch);
    expect(trace.end == TraceEnd::closed, "the circuit of a crank-rocker is closed");
    const double turned = poses[(trace.count - 1) * 9 + 2] - poses[2];
    expect(std::fabs(std::fabs(turned) - 2 * M_PI) < 1e-6, "the crank has not turned once");
    const double at[] = {(arcs[0] + arcs[1]) / 2};
    const std::int64_t segments[] = {0};
    double pose[9], tangent[9];
    expect(tracing.evaluate(samples, at, segments, 1, pose, tangent, watch) == 1, "no pose between samples");
}

void check_interrupt() {
    const Machine machine = four_bar();
    Motion motion(machine, 0, 2, 1e10);
    expect(motion.run(machine, {}, never).end == End::interrupted, "a long way is not interrupted");
}

void check_wrong_programs() {
    const auto refused = [](Machine machine) {
        OwnPlan plan;
        return !read_plan(machine.program(), plan).empty();
    };
    for (std::size_t i = 0; i < 20; ++i) {
        if ((i > 4 && i < 10)) continue;  // not read of a drive
        if (i == 4) continue;             // its sign
        Machine machine = four_bar();
        machine.operations[i] = i % 10 == 0 ? 9 : 8;
        expect(refused(machine), "a wrong operation is accepted");
        machine.operations[i] = -1;
        expect(refused(machine), "a wrong operation is accepted");
    }
    Machine machine = group();
    machine.owners[2] = 2;
    expect(refused(machine), "a body that is not there");
    machine = group();
    machine.conditions[1] = 2;
    expect(refused(machine), "starts that do not end at the last");
    machine = group();
    machine.kinds[0] = 2;
    expect(refused(machine), "fewer equations than unknowns");
    machine = group();
    machine.values[4] = 1;
    expect(refused(machine), "a law without pieces");
}

// Against the functions of the system, over many powers of ten; an ulp of the result, or of 1 for cosines.
void check_functions() {
    constexpr double ulp = 2.3e-16;
    double number = 1e-300, large = 1;
    for (int k = 0; k < 4000; ++k) {
        number *= 1.411;
        large *= 1.00865;  // up to 1e15
        if (number > 1e299) number = 1e-300;
        const Complex near{std::cos(k * 0.7), std::sin(k * 0.7)}, point = unit_vector(large);
        const Complex directions[] = {near, {near.x, near.y * 1e-9}, {near.x * 1e-9, near.y}, number * near};
        for (const Complex z : directions) {
            const double angle = std::atan2(z.y, z.x);
            expect(std::fabs(direction_angle(z) - angle) <= 4 * ulp * std::fabs(angle), "the angle of a direction");
        }
        for (const double of : {number, 1 + 1e-3 * near.x, large}) {
            const double log = std::log(of);
            expect(std::fabs(logarithm(of) - log) <= 3 * ulp * std::fabs(log), "the logarithm");
        }
        expect(std::fabs(point.x - std::cos(large)) + std::fabs(point.y - std::sin(large)) <= 4 * ulp, "a point of the circle");
    }
}

}  // namespace

int main() {
    check_functions();
    for (int order = 0; order <= most_orders; ++order) check_four_bar(order, 0.01);
    check_four_bar(1, 0.7);
    check_limit();
    check_group();
    check_slider_crank();
    check_designs();
    check_tracing();
    check_interrupt();
    check_wrong_programs();
    std::puts("motion");
}
