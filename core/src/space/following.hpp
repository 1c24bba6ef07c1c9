// A closed linkage in space followed along its drives, with rates of any order up to the third.
//
// The closing conditions, steps and rates of docs/theory/space.md. Lengths are in sizes of the linkage.
#pragma once

#include <cstdint>
#include <vector>

#include "base/watch.hpp"
#include "space/frames.hpp"
#include "space/least_squares.hpp"
#include "space/rods.hpp"

namespace gruebler::space {

inline constexpr int most_orders = 3;
inline constexpr double longest_way = 1e9;  // radians and sizes from row to row: a quarter of an hour

struct Linkage {
    Structure structure;
    const double* frames;   // [nodes, 4, 4] of a node that stands still
    const double* pitches;  // [nodes] of a screw, in lengths a radian
    const double* lengths;  // [rows]
    const double* gears;    // [gears, unknowns] sums of unknowns that are 0: rows behind the others
    int gear_rows;

    int conditions() const { return structure.rows + gear_rows; }
};

// A node that rows ask for, and for which of its axes (bits 0 to 2) and its origin (bit 3).
struct Mark {
    int node, columns;
};

// By how much the rows are open, lengths as such, and the derivatives by all unknowns.
class Conditions : public Tree<double> {
public:
    explicit Conditions(const Linkage& linkage);

    std::vector<double> values, derivatives;  // [conditions], [conditions, unknowns]

    const Linkage& linkage() const { return linkage_; }
    int nodes_of_rows() const { return nodes_of_rows_; }
    const std::vector<Mark>& marks() const { return marks_; }

    void evaluate(const double* q);

private:
    Linkage linkage_;
    int nodes_of_rows_;       // those behind carry links only
    std::vector<Mark> marks_;
    std::vector<std::vector<Part>> between_;
};

// Power series in time of the unknowns and of frames: coefficients of t, t² and t³. With the twists V of the nodes and the
// screws ζ of what moves, V = V of the parent + ζ dq/dt, dζ/dt = [V, ζ], and a frame moves with the twist of its node.
class Series {
public:
    explicit Series(const Conditions& conditions);

    // [4, unknowns]: of the drives the caller writes the coefficients before `solve`, of the others stands 0 there.
    std::vector<double> q;

    // The passive unknowns up to that order.
    void solve(int orders, const std::vector<int>& passive, const LeastSquares& matrix);

    // The coefficient of a frame, or of some of its columns, after `solve`; those below it before it.
    void set_frame(int node, int order, int columns = 15);
    const Frame<double>& frame(int node, int order) const;

private:
    const Conditions& conditions_;
    std::vector<int> moving_, carrier_;                                        // the node that moves a node, -1 for none
    std::vector<Screw<double>> twists_[most_orders], screws_[most_orders];     // coefficients of t^k
    std::vector<Frame<double>> frames_[most_orders];                           // of t^(k + 1)
    std::vector<double> open_, change_;

    const Screw<double>& screw(int node, int order) const;
    void set_twists(int order);
    void set_marks(int order);
    void turn_screws(int order);
    double open(int row, int order) const;
};

struct Path {
    std::int64_t rows;
    int drives, passives, links, rods, orders;
    const std::int64_t* drive;    // [drives] unknowns
    const std::int64_t* passive;  // [passives] unknowns; all others keep their values
    const std::int64_t* link;     // [links] nodes; -1 for a rod
    const std::int64_t* rod;      // [rods, 3] links
    const double* balls;          // [rods, 5, 3] their vectors
    const double* unit;           // the size of the linkage and its centre: poses are in its unit
    const double* start;          // [unknowns] the closed position from which the path begins
    const double* turns;          // [balls, 3, 3] where the turns of balls are counted from there
    const double* values;         // [rows, drives]
    const double* rates;          // [orders, rows, drives] coefficients of t, t², t³
    // Written:
    double* unknowns;     // [orders + 1, rows, unknowns] coefficients
    double* poses;        // [orders + 1, rows, links, 4, 4] derivatives
    double* derivatives;  // [rows, conditions, passives]
    std::uint8_t* passed;  // [rows] whether a change of mode was passed before the row
};

struct Followed {
    std::int64_t rows = 0;              // that were reached
    double part = 1;                    // of the way to the next row, if not all were
    double gap = 0;                     // by which a row is open at most
    std::vector<double> place, turns;   // the last closed position: [unknowns], [balls, 3, 3]
};

// False if the watch ends the work. Cost: about a microsecond a row and loop.
bool follow(const Linkage& linkage, const Path& path, Followed& followed, Watch& watch);

}  // namespace gruebler::space
