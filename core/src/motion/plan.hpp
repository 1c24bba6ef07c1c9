// What a linkage is to the core: what is placed in which order. `read_plan` is the one place where numbers are checked.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "motion/closure.hpp"
#include "motion/complex.hpp"
#include "motion/jets.hpp"

namespace gruebler::motion {

// What an operation does: a driven turn or push, a dyad by its joints, a larger group; a link is carried by its body.
enum class Kind : int { turn, push, rrr, rrp, rpr, prp, rpp, group, carry };

// One side of a joint, in the frame of its link.
struct Element {
    int link;
    Complex point;
    Complex line;  // of modulus 1
};

// The elements of a dyad: the outer ones on what is known, two on the first body, two on the second.
enum Slot : int { outer_a, on_a, inner_a, inner_b, on_b, outer_b, slots };

struct Operation {
    Kind kind;
    int number;            // of the drive, of the dyad or of the larger group
    int elements[slots];   // of a dyad; a drive holds on to `near` and moves the link of `far`
    int body_a, body_b;    // the links that a dyad places; a carried link and its body
    double sign;           // of a drive
    bool driven;           // an RRP whose arm lies on two links: a drive changes its length

    static constexpr int near = outer_a, far = on_a;
};

// A closing condition of a larger group.
struct GroupCondition {
    Condition numbers;
    int elements[2];
    int winding;  // where its angles that count whole turns stand among the unknowns, else -1
};

struct Group {
    int first_condition, last_condition;  // the last is not one of them
    int first_body, last_body;
};

// Read by the walk and by the sweep; plain pointers, since the latter is compiled for several levels.
struct Plan {
    const Operation* operations;
    const Element* elements;
    const double* most;  // (drives,) the longest step of each drive
    int operation_count, element_count, link_count, drive_count, dyad_count;
    double size;  // a length of the order of the linkage
    const Group* groups;
    const GroupCondition* conditions;
    const int* roots;  // (bodies,) the link that stands for a body of a larger group
    int group_count, condition_count, body_count, unknown_count;
    Laws laws;
};

// The flat arrays of Python and of the page.
struct Program {
    const std::int64_t* operations;  // (operation_count, 10)
    const std::int64_t* links;       // (element_count,)
    const Complex* points;           // (element_count,)
    const Complex* lines;            // (element_count,)
    const std::int64_t* conditions;  // (group_count + 1,) where those of a group start
    const std::int64_t* kinds;       // (condition_count,)
    const std::int64_t* sides;       // (2 condition_count,) elements
    const std::int64_t* owners;      // (2 condition_count,) the body of the group, -1 for what is known
    const std::int64_t* bodies;      // (group_count + 1,) where those of a group start
    const std::int64_t* roots;       // (body_count,)
    const double* most;              // (drive_count,)
    const double* values;            // (condition_count, 6)
    const std::int64_t* windings;    // (condition_count,)
    Laws laws;
    double size;
    std::int64_t operation_count, element_count, link_count, drive_count, dyad_count;
    std::int64_t group_count, condition_count, body_count, unknown_count;
};

// A plan with its memory.
struct OwnPlan {
    std::vector<Operation> operations;
    std::vector<Element> elements;
    std::vector<Group> groups;
    std::vector<GroupCondition> conditions;
    std::vector<int> roots;

    Plan view(const Program& program) const;
    // Another design of the same program.
    void set_elements(const Complex* points, const Complex* lines);
};

// Fills a plan; returns what is wrong, in words, or nothing.
std::string read_plan(const Program& program, OwnPlan& plan);

}  // namespace gruebler::motion
