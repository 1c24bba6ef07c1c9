#include "motion/newton.hpp"

#include <cmath>

namespace gruebler::motion {
namespace {

constexpr double arrived = 1e-9;   // of the size: the step behind one so small is below rounding, since each squares the error
constexpr double closed = 1e-14;   // of the size: an equation that misses by less, some ten roundings, is satisfied
constexpr double astray = 10;      // sizes: a step that long leads away from every position
constexpr double finite = 1e300;   // a residual that is larger, or NaN, comes of an overflow
constexpr double damping = 1e-12;  // of the sum of squares of the Jacobian: holds directions with a singular value below 1e-6
constexpr int damped_steps = 4;    // each squares the error, from that of an extrapolation (some 1e-2) down to rounding

constexpr double vanishing = 1e-7;  // of the scaled Jacobian: Newton's method leaves a singular position off by some 1e-8

// Angles are compared with lengths by the size.
double scale_of(int unknown, double size) { return unknown % 3 == 2 ? size : 1.0; }

}  // namespace

NewtonEnd newton(const Conditions& conditions, const Reduction& reduction, double* x, int n, int steps, LinearRoom& room) {
    double *residual = room.residual.data(), *jacobian = room.jacobian.data();
    const double size = conditions.size;
    for (int step = 0; step < steps; ++step) {
        const double miss = closing(conditions, x, n, residual, jacobian);
        if (!(miss < finite)) return {-1, 0};
        const double determinant = factor(reduction, n, room);
        if (determinant == 0) return {miss < closed * size ? step : -1, 0};
        solve_factored(reduction, n, room, residual);
        double moved = 0;
        for (int k = 0; k < n; ++k) {
            const double way = std::fabs(residual[k]) * scale_of(k, size);
            if (!(way <= moved)) moved = way;  // so that NaN wins
        }
        if (!(moved < astray * size)) return {-1, 0};
        for (int k = 0; k < n; ++k) x[k] -= residual[k];
        if (moved < arrived * size) return {step + 1, determinant};
    }
    return {-1, 0};
}

bool is_singular(const Conditions& conditions, const double* x, int n, bool has_arrived, LinearRoom& room) {
    double* jacobian = room.jacobian.data();
    const double miss = closing(conditions, x, n, room.residual.data(), jacobian);
    if (!has_arrived && !(miss < closed * conditions.size)) return false;
    for (int i = 0; i < n; ++i) {
        double most = 0;
        for (int k = 0; k < n; ++k) {
            jacobian[i * n + k] /= scale_of(k, conditions.size);
            most = larger(most, std::fabs(jacobian[i * n + k]));
        }
        if (most == 0) return true;
        for (int k = 0; k < n; ++k) jacobian[i * n + k] /= most;
    }
    if (factor(jacobian, n, room.pivots.data()) == 0) return true;
    for (int k = 0; k < n; ++k)
        if (std::fabs(jacobian[k * n + k]) < vanishing) return true;
    return false;
}

void close_near_singular(const Conditions& conditions, double* x, int n, LinearRoom& room) {
    double *residual = room.residual.data(), *jacobian = room.jacobian.data(), *normal = room.factors.data();
    const double size = conditions.size;
    for (int step = 0; step < damped_steps; ++step) {
        closing(conditions, x, n, residual, jacobian);
        double trace = 0;
        for (int i = 0; i < n; ++i) {
            if (i % 3 == 2)
                for (int k = 0; k < n; ++k) jacobian[k * n + i] /= size;
            for (int k = 0; k < n; ++k) trace += square(jacobian[k * n + i]);
        }
        for (int i = 0; i < n; ++i) {
            for (int m = 0; m < n; ++m) {
                double sum = i == m ? damping * trace : 0.0;
                for (int k = 0; k < n; ++k) sum += jacobian[k * n + i] * jacobian[k * n + m];
                normal[i * n + m] = sum;
            }
        }
        double* gradient = jacobian;  // its first row: column i is read before it is written
        for (int i = 0; i < n; ++i) {
            double sum = jacobian[i] * residual[0];
            for (int k = 1; k < n; ++k) sum += jacobian[k * n + i] * residual[k];
            gradient[i] = sum;
        }
        factor(normal, n, room.pivots.data());
        solve_factored(normal, n, room.pivots.data(), gradient);
        for (int i = 0; i < n; ++i) x[i] -= gradient[i] / scale_of(i, size);
    }
}

}  // namespace gruebler::motion
