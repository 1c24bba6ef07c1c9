// Work is bounded by steps, not by rows: a single row may take hours.
#pragma once

#include <cstdint>

namespace gruebler {

// About 0.1 s of work: seldom enough to cost nothing, often enough for Ctrl-C.
inline constexpr std::int64_t steps_between_questions = std::int64_t{1} << 24;

// Asked now and then whether to go on.
struct Watch {
    bool (*goes_on)(void* context);
    void* context;
    std::int64_t steps_left = steps_between_questions;
};

// Notes that so many steps were done, of some nanoseconds each; false if the work is to end.
inline bool spend(Watch& watch, std::int64_t steps) {
    watch.steps_left -= steps;
    if (watch.steps_left > 0) return true;
    watch.steps_left = steps_between_questions;
    return watch.goes_on(watch.context);
}

}  // namespace gruebler
