// One pose of a linkage: everything placed in solving order, and whether that may be trusted.
#pragma once

#include <vector>

#include "motion/dyads.hpp"
#include "motion/newton.hpp"
#include "motion/plan.hpp"
#include "motion/poses.hpp"

namespace gruebler::motion {

inline constexpr double near_change = 1e-3;  // below this root a change point is looked for
inline constexpr double kept = 0.25;         // of its last value: a root that keeps less may have come through zero
inline constexpr double expected = 0.5;  // of its last value: a root that is expected to keep less falls to a zero
inline constexpr double nearest = 1e-8;  // of the longest step: nearer to a singular place of a group it is a limit

// What a trial pose is: to be trusted; near a zero of a dyad's root; without a dyad that closes; with a larger group that is
// not where it should be; with outer joints of a dyad that meet, its direction still unknown.
enum class Verdict { good, approach, apart, lost, meet };

// A place on the path with what poses there let expect of others.
struct Remembered {
    double at = 0;                     // in rows
    std::vector<double> roots;         // (dyads,) signed
    std::vector<double> unknowns;      // (unknowns,)
    std::vector<double> determinants;  // (groups,)
};

// What is known of a dyad from here on.
struct DyadMemory {
    double change;      // where the root goes through zero, NaN if that is not known
    double after;       // the sign behind that; 0 if it is not known
    double met;         // the place on the path where the outer joints meet
    Complex direction;  // the turn of the first body there
};

// How a larger group is treated at a singular place.
enum class Singular { none, jumped, in_it };

// One linkage with its last poses and room for a trial; the memory of one call.
class Placing {
public:
    Placing(const Plan& plan, int links);

    // Begins anew, with these signs of the dyads and these unknowns of larger groups near the first row.
    void begin(const double* signs, const double* start);

    // Sets the drives to a place on the path; rates are known at rows only.
    void set_drives(const Path& path, double at);
    void set_drive(int d, double value) { drives_[d] = value; }

    // Places everything where the drives stand, at that place on the path.
    Verdict try_pose(int order, double at);

    // The trial becomes the last pose.
    void accept(double at);

    // How far ahead of the last pose the determinant of a larger group is zero if it falls on so, or infinity.
    double zero_ahead(int group) const;

    // The square of a dyad at whose elements the trial has stopped.
    double stopped_square(int dyad) const;

    // The operation that places a dyad.
    const Operation& dyad(int number) const { return plan_.operations[operation_of_[number]]; }

    const Plan& plan() const { return plan_; }
    // Another design of the same program, whose elements stand where those of the plan do.
    void set_design(const double* most, double size) {
        plan_.most = most;
        plan_.size = size;
    }

    std::vector<BodyJet> links;         // the trial
    std::vector<Complex> last_turns;    // of the pose accepted last
    std::vector<std::int64_t> whole_turns;
    std::vector<double> signs;          // (dyads,) of the roots, from here on
    std::vector<DyadMemory> dyads;
    Remembered last[3];  // newest first
    Remembered trial;
    int filled = 0;      // how many of the last poses there are
    int which = 0;       // the dyad or group that spoils the trial
    int singular_group = 0;
    Singular singular = Singular::none;
    double unit = 1;     // the longest step of the drives, in rows
    std::int64_t tried = 0;

private:
    Plan plan_;
    std::vector<int> operation_of_;
    std::vector<double> drives_;  // (4, drives) values and their three derivatives
    DyadElements elements_{};
    // A larger group: its sides, its conditions, its bodies, what its unknowns are expected to be.
    std::vector<ElementJet> sides_;
    std::vector<Condition> conditions_;
    std::vector<BodyJet> bodies_;
    std::vector<double> predicted_;
    std::vector<Reduction> reductions_;  // (groups,)
    LinearRoom room_;

    void move_drive(const Operation& operation, int order);
    Verdict place_dyad_of(const Operation& operation, int order, double at);
    bool place_group(int number, int order, double at);
    Verdict trust_root(double square, int number, double at, double& root) const;
    Verdict trust_sine(double sine, int number) const;
    void predict(const Group& group, double at);
    void set_conditions(const Group& group);
    bool is_within_reach(int number, double at) const;
    bool is_expected(const Group& group, int number) const;
    bool wind(const Group& group);
    void set_group_rates(int number, const Conditions& conditions, int order, bool known);
};

}  // namespace gruebler::motion
