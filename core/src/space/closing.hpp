// The rows of a tree, their derivatives by the unknowns and by the time of a way of the dimensions.
#pragma once

#include <vector>

#include "space/modes.hpp"

namespace gruebler::space {

class Closing : public Tree<Complex> {
public:
    Closing(const Structure& structure, const Way& way);

    // The values of the rows, their derivatives by the unknowns [rows, unknowns], their rates by the time.
    std::vector<Complex> values, derivatives, rates;

    void evaluate(const Complex* q, double time);

    // The solution of derivatives x = right, in its place; false if the matrix is singular. Changes the derivatives.
    bool solve(std::vector<Complex>& right);

private:
    Way way_;
    double time_ = -1;
    std::vector<std::vector<Part>> between_;

    void place_dimensions(double time);
    void close(int row, double time);
};

}  // namespace gruebler::space
