// A linkage moved along a path of its drives: every group after the other, every step checked for continuity.
//
// Between rows the drives move on straight lines; a step is halved until the pose is near the one that the last poses let expect,
// so that nothing jumps. Where rows are close and nothing special happens, a sweep takes many of them at once. The theorems
// behind the checks are in docs/theory/kinematics.md.
#pragma once

#include <vector>

#include "base/watch.hpp"
#include "motion/placing.hpp"
#include "motion/sweep.hpp"

namespace gruebler::motion {

// How a run ended: at its last row; where a dyad cannot be assembled any more; where a larger group cannot be followed; or at
// its first row already.
enum class End : int { done, limit, singular, start, interrupted };

struct Outcome {
    End end;
    std::int64_t reached;  // rows that are written
    double at;             // where on the path it stopped, in rows
    int fault;             // the dyad, or -1 minus the larger group
};

// The memory of one call, for any number of runs of one linkage.
class Walk {
public:
    Walk(const Plan& plan, const Path& path, const Poses& poses, Sweep* sweep);

    // Moves along the path from a position with these signs of the dyads and near these unknowns of larger groups.
    Outcome follow(const double* signs, const double* start, Watch& watch);

    void set_design(const double* most, double size) { placing_.set_design(most, size); }

private:
    // Where on the path something is least, and whether it is negative there.
    struct Change {
        double place;
        bool negative;
    };

    // The next step, and where ahead something cannot be assembled.
    struct Pace {
        double step, fault;
    };

    // From one row to the next.
    struct Reached {
        End end;
        double at;
        Pace pace;
        int number;
    };

    Placing placing_;
    const Path path_;
    const Poses poses_;
    Sweep* const sweep_;
    const std::uint64_t placed_;
    std::vector<BodyRows> bodies_;

    Verdict try_at(int order, double at);
    Reached walk_to(std::int64_t row, Pace pace, Watch& watch);
    void record(std::int64_t row);
    void recall(std::int64_t row);
    double least_root() const;
    bool is_expecting() const;
    double square_at(double at, int number);
    Change look_for_change(double reach, double turn, int number);
    double turn_ahead(double at, double reach) const;
    Pace approach(double step, int number);
    int reversed() const;
    bool remember(std::int64_t row);
    bool is_other_side(const Remembered& pose) const;
    double unit(std::int64_t row) const;
    void meet(double at);
    bool is_straight(int group) const;
    bool cross_change(std::int64_t row, int group);
    bool place_between(std::int64_t row);
    void return_to(std::int64_t row);
};

}  // namespace gruebler::motion
