// The rows of a tree, their derivatives by the unknowns and by the time of a way of the dimensions.
#pragma once

#include <vector>

#include "space/modes.hpp"

namespace gruebler::space {

struct Vector {
    Complex x[3];
};

// A rigid motion with complex numbers: the rotation by rows, where the origin goes.
struct Frame {
    Complex r[9];
    Complex p[3];
    Vector axis(int i) const { return {{r[i], r[3 + i], r[6 + i]}}; }
};

// A twist or a wrench about the origin.
struct Screw {
    Vector turn, shift;
};

// A rotation by turns about x, y, z in this order, applied from the right.
void turn_further(Complex* rotation, const Complex* angles);

// A step of Newton and Schulz towards the next rotation.
void make_orthogonal(Complex* rotation);

class Closing {
public:
    Closing(const Structure& structure, const Way& way);

    // Where the turns of balls are counted from, [balls, 3, 3].
    std::vector<Complex> turns;

    // The values of the rows, their derivatives by the unknowns [rows, unknowns], their rates by the time.
    std::vector<Complex> values, derivatives, rates;

    const Frame& frame(int node) const { return frames_[static_cast<std::size_t>(node)]; }

    void evaluate(const Complex* q, double time);

    // The solution of derivatives x = right, in its place; false if the matrix is singular. Changes the derivatives.
    bool solve(std::vector<Complex>& right);

private:
    struct Part {  // of a row: what lies between its nodes
        int node;
        double sign;
    };

    Structure structure_;
    Way way_;
    double time_ = -1;
    std::vector<Frame> still_, frames_;
    std::vector<Screw> screws_;
    std::vector<std::vector<Part>> between_;

    const std::int64_t* node(int k) const { return structure_.node + k * node_fields; }
    void place_dimensions(double time);
    void move(const Complex* q, double time);
    void close(int row, double time);
};

}  // namespace gruebler::space
