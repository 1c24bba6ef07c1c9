#include "motion/plan.hpp"

#include <limits>

namespace gruebler::motion {
namespace {

constexpr int operation_width = 10;
constexpr int value_width = 6;
constexpr std::int64_t most_items = std::numeric_limits<int>::max() / 8;  // they are numbered by int, three unknowns a body

// Reads the numbers of a program one after another; `fault` is what is wrong first.
class Reader {
public:
    Reader(const Program& program, OwnPlan& plan) : program_(program), plan_(plan) {}

    std::string read() {
        read_elements();
        if (fault_.empty()) read_operations();
        if (fault_.empty()) read_groups();
        return fault_;
    }

private:
    const Program& program_;
    OwnPlan& plan_;
    std::string fault_;

    // An index below a count, else 0 and the fault.
    int index(std::int64_t number, std::int64_t count, const std::string& where, const char* what) {
        if (number >= 0 && number < count) return static_cast<int>(number);
        if (fault_.empty())
            fault_ = where + ": there is no " + what + " " + std::to_string(number) + ", there are " +
                     std::to_string(count);
        return 0;
    }

    void read_elements() {
        const std::int64_t counts[] = {program_.operation_count, program_.element_count, program_.link_count,
                                       program_.drive_count,     program_.dyad_count,    program_.group_count,
                                       program_.condition_count, program_.body_count,    program_.unknown_count};
        for (const std::int64_t count : counts)
            if (count > most_items) fault_ = "the program is too long";
        if (!fault_.empty()) return;
        plan_.elements.resize(program_.element_count);
        for (std::int64_t e = 0; e < program_.element_count; ++e)
            plan_.elements[e].link = index(program_.links[e], program_.link_count, "element " + std::to_string(e), "link");
        plan_.set_elements(program_.points, program_.lines);
        for (std::int64_t b = 0; b < program_.body_count; ++b)
            plan_.roots.push_back(index(program_.roots[b], program_.link_count, "body " + std::to_string(b), "link"));
    }

    void read_operations() {
        for (std::int64_t o = 0; o < program_.operation_count; ++o) {
            const std::int64_t* row = program_.operations + o * operation_width;
            const std::string where = "operation " + std::to_string(o);
            Operation operation{};
            operation.kind = static_cast<Kind>(index(row[0], static_cast<int>(Kind::carry) + 1, where, "kind"));
            switch (operation.kind) {
                case Kind::turn:
                case Kind::push:
                    operation.number = index(row[1], program_.drive_count, where, "drive");
                    operation.elements[Operation::near] = index(row[2], program_.element_count, where, "element");
                    operation.elements[Operation::far] = index(row[3], program_.element_count, where, "element");
                    operation.sign = static_cast<double>(row[4]);
                    break;
                case Kind::group:
                    operation.number = index(row[1], program_.group_count, where, "larger group");
                    break;
                case Kind::carry:
                    operation.body_a = index(row[1], program_.link_count, where, "link");
                    operation.body_b = index(row[2], program_.link_count, where, "link");
                    break;
                default:
                    read_dyad(row, where, operation);
            }
            plan_.operations.push_back(operation);
        }
    }

    void read_dyad(const std::int64_t* row, const std::string& where, Operation& operation) {
        for (int slot = 0; slot < slots; ++slot)
            operation.elements[slot] = index(row[1 + slot], program_.element_count, where, "element");
        operation.body_a = index(row[7], program_.link_count, where, "link");
        operation.body_b = index(row[8], program_.link_count, where, "link");
        operation.number = index(row[9], program_.dyad_count, where, "dyad");
        if (!fault_.empty()) return;
        const auto link = [&](Slot slot) { return plan_.elements[operation.elements[slot]].link; };
        operation.driven = operation.kind == Kind::rrp && link(on_a) != link(inner_a);
    }

    void read_groups() {
        if (!ascends(program_.conditions, program_.condition_count) || !ascends(program_.bodies, program_.body_count)) {
            fault_ = "the starts of the larger groups do not ascend from 0 to what there is";
            return;
        }
        if (program_.unknown_count < 3 * program_.body_count) fault_ = "there are fewer unknowns than bodies need";
        for (std::int64_t g = 0; g < program_.group_count && fault_.empty(); ++g) {
            const Group group{static_cast<int>(program_.conditions[g]), static_cast<int>(program_.conditions[g + 1]),
                              static_cast<int>(program_.bodies[g]), static_cast<int>(program_.bodies[g + 1])};
            int count = 0;
            for (int c = group.first_condition; c < group.last_condition && fault_.empty(); ++c) {
                read_condition_of(group, c);
                count += equations(plan_.conditions.back().numbers.kind);
            }
            if (fault_.empty() && count != 3 * (group.last_body - group.first_body))
                fault_ = "larger group " + std::to_string(g) + " has not as many equations as unknowns";
            plan_.groups.push_back(group);
        }
    }

    bool ascends(const std::int64_t* starts, std::int64_t last) const {
        for (std::int64_t g = 0; g < program_.group_count; ++g)
            if (starts[g] > starts[g + 1]) return false;
        return starts[0] == 0 && starts[program_.group_count] == last;
    }

    void read_condition_of(const Group& group, int c) {
        const std::string where = "condition " + std::to_string(c);
        const double* row = program_.values + c * value_width;
        const double values[] = {row[0], row[1], row[2], 0, 0, row[3], row[4], row[5]};
        GroupCondition condition{};
        std::string wrong = read_condition(program_.kinds[c], values, program_.owners[2 * c], program_.owners[2 * c + 1],
                                           group.last_body - group.first_body, program_.laws, condition.numbers);
        if (wrong.empty() && condition.numbers.kind > Joint::face) wrong = "is of a kind whose rates are not known";
        if (!wrong.empty()) fault_ = where + " " + wrong;
        for (int side = 0; side < 2; ++side)
            condition.elements[side] = index(program_.sides[2 * c + side], program_.element_count, where, "element");
        const std::int64_t first = program_.windings[c];
        condition.winding =
            first < 0 ? none : index(first, program_.unknown_count - 1, where, "pair of unknowns");
        plan_.conditions.push_back(condition);
    }
};

}  // namespace

void OwnPlan::set_elements(const Complex* points, const Complex* lines) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
        elements[e].point = points[e];
        elements[e].line = lines[e];
    }
}

Plan OwnPlan::view(const Program& program) const {
    return {operations.data(),
            elements.data(),
            program.most,
            static_cast<int>(operations.size()),
            static_cast<int>(elements.size()),
            static_cast<int>(program.link_count),
            static_cast<int>(program.drive_count),
            static_cast<int>(program.dyad_count),
            program.size,
            groups.data(),
            conditions.data(),
            roots.data(),
            static_cast<int>(groups.size()),
            static_cast<int>(conditions.size()),
            static_cast<int>(roots.size()),
            static_cast<int>(program.unknown_count),
            program.laws};
}

std::string read_plan(const Program& program, OwnPlan& plan) { return Reader(program, plan).read(); }

}  // namespace gruebler::motion
