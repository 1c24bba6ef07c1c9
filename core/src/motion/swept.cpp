#include "motion/sweep.hpp"

namespace gruebler::motion {

std::uint64_t swept_links(const Plan& plan) {
    if (plan.condition_count > 0 || plan.link_count > most_swept) return 0;
    const auto link_of = [&](const Operation& operation, int slot) {
        return plan.elements[operation.elements[slot]].link;
    };
    const auto bit = [](int link) { return std::uint64_t{1} << link; };
    std::uint64_t placed = 0;
    for (int o = 0; o < plan.operation_count; ++o) {
        const Operation& operation = plan.operations[o];
        if (operation.kind == Kind::turn) {
            placed |= bit(link_of(operation, Operation::far));
            continue;
        }
        if (operation.kind != Kind::rrr && operation.kind != Kind::rrp && operation.kind != Kind::rpr) return 0;
        for (const Slot slot : {on_a, inner_a})
            if (link_of(operation, slot) != operation.body_a) return 0;
        for (const Slot slot : {inner_b, on_b})
            if (link_of(operation, slot) != operation.body_b) return 0;
        if (operation.kind == Kind::rrp && placed & bit(link_of(operation, outer_b))) return 0;
        placed |= bit(operation.body_a) | bit(operation.body_b);
    }
    return placed;
}

void rest(int links, BodyRows* bodies) {
    for (int link = 0; link < links; ++link) {
        bodies[link] = {};
        for (double& x : bodies[link].turn_x) x = 1;
    }
}

}  // namespace gruebler::motion
