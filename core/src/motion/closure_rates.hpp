// Derivatives of closing conditions: what is known of them beside the Jacobian times the unknown rates.
#pragma once

#include "motion/closure.hpp"

namespace gruebler::motion {

// Writes the right-hand side of `Jacobian * unknown = target` for the derivatives of an order from 1 to 3. The jets of the
// bodies are known up to order - 1; their entries of this order and above are zero. Not for trains and travels.
void closing_rates(int order, const Conditions& conditions, const BodyJet* bodies, double* target);

}  // namespace gruebler::motion
