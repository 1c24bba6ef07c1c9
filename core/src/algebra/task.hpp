// The numbers of a task, and the straight way from one task to another; what they mean is up to the system of equations.
#pragma once

#include "algebra/lanes.hpp"

namespace gruebler::algebra::inline GRUEBLER_LEVEL {

template <int lanes>
struct TaskOf {
    LanesOf<lanes> row[4];

    // complex[4, lanes], as pairs of doubles.
    static TaskOf read(const double* numbers) {
        TaskOf task;
        for (LanesOf<lanes>& row : task.row)
            for (int i = 0; i < lanes; ++i, numbers += 2) row.set(i, {numbers[0], numbers[1]});
        return task;
    }
};

// Where a straight way is at a time, and how fast it goes.
template <int lanes>
struct Way {
    using Task = TaskOf<lanes>;
    Task begin, speed;

    static Way between(const Task& begin, const Task& end) {
        Way way{begin, end};
        combine(way.speed, end, begin, -1);
        return way;
    }
    void at(double time, Task& task) const { combine(task, begin, speed, time); }

private:
    static void combine(Task& out, const Task& first, const Task& second, double k) {
        for (int r = 0; r < 4; ++r)
            for (int i = 0; i < lanes; ++i) {
                out.row[r].re[i] = first.row[r].re[i] + k * second.row[r].re[i];
                out.row[r].im[i] = first.row[r].im[i] + k * second.row[r].im[i];
            }
    }
};

}  // namespace gruebler::algebra::inline GRUEBLER_LEVEL
