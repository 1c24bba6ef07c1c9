// The door to the page: one call, all its numbers in one block of memory. `explorer/src/kernel.ts` is the other side.
//
// The block holds 64-bit words: the counts, the size, the arrays of a `Program`, the path with speeds, signs, start and
// smallest step, then what is found: the outcome and the arrays of `Poses`. It is kept from call to call, and grows.
#include <string>
#include <vector>

#include "motion/walk.hpp"
#include "exports.hpp"

namespace gruebler::motion {
namespace {

// The first words of the block, all of them integers.
struct Counts {
    std::int64_t operations, elements, links, drives, dyads, groups, conditions, bodies, unknowns, pieces, width;
    std::int64_t rows, order;
};

// What the page reads first.
struct Found {
    double end, reached, at, fault;
};

constexpr int patience = 30;  // questions of the watch, some seconds in all: then the page would rather have its window back

std::vector<double> block;
std::string wrong;

bool goes_on(void* left) { return --*static_cast<int*>(left) > 0; }

// Array after array out of the block.
class Words {
public:
    explicit Words(double* at) : at_(at) {}

    template <class Number>
    Number* next(std::int64_t count) {
        static_assert(sizeof(Number) % sizeof(double) == 0 || sizeof(double) % sizeof(Number) == 0);
        auto* const array = reinterpret_cast<Number*>(at_);
        at_ += (static_cast<std::size_t>(count) * sizeof(Number) + sizeof(double) - 1) / sizeof(double);
        return array;
    }

private:
    double* at_;
};

Program program_of(const Counts& has, Words& words) {
    Program program{};
    program.size = *words.next<double>(1);
    program.operations = words.next<std::int64_t>(10 * has.operations);
    program.links = words.next<std::int64_t>(has.elements);
    program.points = words.next<Complex>(has.elements);
    program.lines = words.next<Complex>(has.elements);
    program.conditions = words.next<std::int64_t>(has.groups + 1);
    program.kinds = words.next<std::int64_t>(has.conditions);
    program.sides = words.next<std::int64_t>(2 * has.conditions);
    program.owners = words.next<std::int64_t>(2 * has.conditions);
    program.bodies = words.next<std::int64_t>(has.groups + 1);
    program.roots = words.next<std::int64_t>(has.bodies);
    program.most = words.next<double>(has.drives);
    program.values = words.next<double>(6 * has.conditions);
    program.windings = words.next<std::int64_t>(has.conditions);
    program.laws = {words.next<double>(has.pieces * has.width), has.pieces, has.width};
    program.operation_count = has.operations;
    program.element_count = has.elements;
    program.link_count = has.links;
    program.drive_count = has.drives;
    program.dyad_count = has.dyads;
    program.group_count = has.groups;
    program.condition_count = has.conditions;
    program.body_count = has.bodies;
    program.unknown_count = has.unknowns;
    return program;
}

Poses poses_of(const Counts& has, Words& words) {
    Poses poses{};
    poses.places = words.next<Complex>((has.order + 1) * has.links * has.rows);
    poses.turns = words.next<Complex>(has.links * has.rows);
    poses.rates = words.next<double>(has.order * has.links * has.rows);
    poses.roots = words.next<double>(has.dyads * has.rows);
    poses.unknowns = words.next<double>(has.unknowns * has.rows);
    poses.whole = words.next<std::int32_t>(has.links * has.rows);
    poses.order = static_cast<int>(has.order);
    poses.links = static_cast<int>(has.links);
    poses.dyads = static_cast<int>(has.dyads);
    poses.unknown_count = static_cast<int>(has.unknowns);
    poses.rows = has.rows;
    return poses;
}

}  // namespace

// The block, with room for at least so many words.
EXPORT double* reserve(std::uint32_t words) {
    if (block.size() < words) block.resize(words);
    return block.data();
}

// Moves the linkage of the block along the path of the block. Returns null, or a text of what is wrong with the program.
EXPORT const char* run() {
    Words words(block.data());
    const Counts has = *words.next<Counts>(1);
    const Program program = program_of(has, words);
    const auto* values = words.next<double>(has.rows * has.drives);
    const auto* speeds = words.next<double>(has.order * has.rows * has.drives);
    const auto* signs = words.next<double>(has.dyads);
    const auto* start = words.next<double>(has.unknowns);
    const double least = *words.next<double>(1);
    auto* const found = words.next<Found>(1);
    const Poses poses = poses_of(has, words);
    OwnPlan plan;
    wrong = read_plan(program, plan);
    if (!wrong.empty()) return wrong.c_str();
    const Path path{values, speeds, has.rows, static_cast<int>(has.drives), static_cast<int>(has.order), least};
    Walk walk(plan.view(program), path, poses, baseline::sweep);
    int left = patience;
    Watch watch{goes_on, &left};
    const Outcome outcome = walk.follow(signs, start, watch);
    *found = {static_cast<double>(outcome.end), static_cast<double>(outcome.reached), outcome.at,
              static_cast<double>(outcome.fault)};
    return nullptr;
}

// The angle of a direction, with as many whole turns as bring it next to one near by.
EXPORT double unwound(double x, double y, double near) { return unwound_angle({x, y}, near); }

}  // namespace gruebler::motion
