#include "design/pose_closing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/circle.hpp"

namespace gruebler::design {
namespace {

using namespace motion;

constexpr double reached_at = 1e-12;  // sizes
constexpr double redundant = 1e-10;   // of the largest diagonal: a condition that follows from those before it

Complex turned_on(const double* q, std::int64_t body, std::int64_t bodies) {
    return body < bodies ? unit_vector(q[3 * body + 2]) : Complex{1, 0};
}

// One pose: its joints with their gaps and slopes, and the transposed Jacobian factorised by reflections, without exchanges.
class Pose {
public:
    explicit Pose(const Closing& all)
        : all_(all),
          unknowns_(all.unknowns()),
          equations_(all.equations()),
          joined_(all.joint_count),
          matrix_(unknowns_ * equations_),
          reflectors_(unknowns_ * equations_),
          shares_(equations_),
          row_(equations_) {}

    void join(const double* q) {
        for (std::int64_t j = 0; j < all_.joint_count; ++j) {
            const ClosedJoint& joint = all_.joints[j];
            Joined& here = joined_[j];
            Complex point[2];
            for (int side = 0; side < 2; ++side) {
                const std::int64_t body = joint.bodies[side];
                const double* own = all_.p + joint.at[side];
                here.turn[side] = turned_on(q, body, all_.body_count);
                here.arm[side] = here.turn[side] * Complex{own[0], own[1]};
                point[side] = here.arm[side];
                if (body < all_.body_count) point[side] += Complex{q[3 * body], q[3 * body + 1]};
            }
            here.gap = point[1] - point[0];
            if (joint.slides) {
                const Complex first = here.turn[0] * unit_vector(all_.p[joint.at[0] + 2]);
                const Complex other = here.turn[1] * unit_vector(all_.p[joint.at[1] + 2]);
                here.across = left(first);
                here.along = dot(first, here.gap);
                here.cosine = dot(first, other);
                here.sine = cross(first, other);
            }
        }
    }

    // Of equation 2 j and 2 j + 1; the larger of their sizes so far.
    double gaps(double* gaps) const {
        double most = 0;
        for (std::int64_t j = 0; j < all_.joint_count; ++j) {
            const Joined& here = joined_[j];
            const bool slides = all_.joints[j].slides;
            gaps[2 * j] = slides ? dot(here.across, here.gap) : here.gap.x;
            gaps[2 * j + 1] = slides ? here.sine : here.gap.y;
            for (int k = 0; k < 2; ++k) {
                const double size = std::fabs(gaps[2 * j + k]);
                if (!(size <= most)) most = size;  // NaN, too
            }
            if (!std::isfinite(most)) return most;
        }
        return most;
    }

    // The Jacobian by weighted unknowns, transposed.
    void differentiate() {
        std::fill(matrix_.begin(), matrix_.end(), 0.0);
        for (std::int64_t j = 0; j < all_.joint_count; ++j) {
            const ClosedJoint& joint = all_.joints[j];
            const Joined& here = joined_[j];
            for (int side = 0; side < 2; ++side) {
                const std::int64_t body = joint.bodies[side];
                if (body == all_.body_count) continue;
                const double sign = side ? 1 : -1;
                const Complex speed = left(here.arm[side]);
                if (!joint.slides) {
                    slope(3 * body, 2 * j) = sign * all_.size;
                    slope(3 * body + 1, 2 * j + 1) = sign * all_.size;
                    slope(3 * body + 2, 2 * j) = sign * speed.x;
                    slope(3 * body + 2, 2 * j + 1) = sign * speed.y;
                    continue;
                }
                slope(3 * body, 2 * j) = sign * all_.size * here.across.x;
                slope(3 * body + 1, 2 * j) = sign * all_.size * here.across.y;
                slope(3 * body + 2, 2 * j) = sign * dot(here.across, speed) - (side ? 0 : here.along);
                slope(3 * body + 2, 2 * j + 1) = sign * here.cosine;
            }
        }
    }

    // Its factors.
    void factor() {
        differentiate();
        double largest = 0;
        for (std::int64_t k = 0; k < equations_; ++k) {
            reflect_column(k);
            largest = larger(largest, std::fabs(slope(k, k)));
        }
        for (std::int64_t k = 0; k < equations_; ++k)
            if (std::fabs(slope(k, k)) <= redundant * largest) slope(k, k) = largest / redundant;
    }

    // Takes the least weighted change that makes up for the gaps off q; both are changed.
    void correct(double* gaps, double* q, double* room) const {
        for (std::int64_t k = 0; k < equations_; ++k) {
            double rest = gaps[k];
            for (std::int64_t i = 0; i < k; ++i) rest -= at(i, k) * gaps[i];
            gaps[k] = rest / at(k, k);
        }
        for (std::int64_t i = 0; i < unknowns_; ++i) room[i] = i < equations_ ? gaps[i] : 0;
        backward(room);
        for (std::int64_t i = 0; i < unknowns_; ++i) q[i] -= weight(i) * room[i];
    }

    // Of the gaps, by the pose and by the dimensions: (equations, unknowns) and (equations, dimensions).
    void slopes(double* by_pose, double* by_sizes) {
        differentiate();
        for (std::int64_t k = 0; k < equations_; ++k) {
            for (std::int64_t i = 0; i < unknowns_; ++i) by_pose[k * unknowns_ + i] = at(i, k) / weight(i);
            std::fill(row_.begin(), row_.end(), 0.0);
            row_[k] = 1;
            weigh(row_.data(), by_sizes + k * all_.size_count);
        }
    }

    void motion(double* motion, double* room) const {
        const std::int64_t freedoms = all_.freedoms();
        for (std::int64_t f = 0; f < freedoms; ++f) {
            std::fill(room, room + unknowns_, 0.0);
            room[unknowns_ - freedoms + f] = 1;
            backward(room);
            for (std::int64_t i = 0; i < unknowns_; ++i) motion[i * freedoms + f] = weight(i) * room[i];
        }
    }

    // Of one quantity, by multipliers of the equations.
    void gradient(const double* by_pose, double* by_sizes, double* room) const {
        for (std::int64_t i = 0; i < unknowns_; ++i) room[i] = weight(i) * by_pose[i];
        for (std::int64_t k = 0; k < equations_; ++k) reflect(k, room);
        for (std::int64_t k = equations_; k-- > 0;) {
            double rest = room[k];
            for (std::int64_t j = k + 1; j < equations_; ++j) rest -= at(k, j) * room[j];
            room[k] = rest / at(k, k);
        }
        weigh(room, by_sizes);
        for (std::int64_t k = 0; k < all_.size_count; ++k) by_sizes[k] = -by_sizes[k];
    }

    // How the gaps, times these weights, change with the dimensions in all.
    void weigh(const double* weights, double* by_sizes) const {
        std::fill(by_sizes, by_sizes + all_.size_count, 0.0);
        for (std::int64_t j = 0; j < all_.joint_count; ++j) {
            const ClosedJoint& joint = all_.joints[j];
            const Joined& here = joined_[j];
            const double first = weights[2 * j], second = weights[2 * j + 1];
            const Complex force = joint.slides ? first * here.across : Complex{first, second};
            for (int side = 0; side < 2; ++side) {
                const double sign = side ? 1 : -1;
                const Complex own = conjugate(here.turn[side]) * force;
                double* changes = by_sizes + joint.at[side];
                changes[0] += sign * own.x;
                changes[1] += sign * own.y;
                if (joint.slides) changes[2] += sign * second * here.cosine - (side ? 0 : first * here.along);
            }
        }
    }

private:
    struct Joined {
        Complex turn[2], arm[2];
        Complex gap;
        Complex across;             // of a slide, on the first body
        double along, sine, cosine;  // the gap along it; of the second line seen from the first
    };

    const Closing& all_;
    std::int64_t unknowns_, equations_;
    std::vector<Joined> joined_;
    std::vector<double> matrix_, reflectors_, shares_, row_;

    double& slope(std::int64_t unknown, std::int64_t equation) { return matrix_[unknown * equations_ + equation]; }
    double at(std::int64_t i, std::int64_t k) const { return matrix_[i * equations_ + k]; }
    double weight(std::int64_t unknown) const { return unknown % 3 == 2 ? 1 : all_.size; }

    // 1 - share v v^T with v_k = 1 brings column k of the rest to a multiple of the unit vector, and changes those after it.
    void reflect_column(std::int64_t k) {
        double* v = reflectors_.data() + k * unknowns_;
        double square = 0;
        for (std::int64_t i = k + 1; i < unknowns_; ++i) square += at(i, k) * at(i, k);
        shares_[k] = 0;
        std::fill(v, v + unknowns_, 0.0);
        if (square == 0) return;
        const double first = at(k, k);
        const double length = std::copysign(std::sqrt(first * first + square), first);
        shares_[k] = (first + length) / length;
        for (std::int64_t i = k + 1; i < unknowns_; ++i) v[i] = at(i, k) / (first + length);
        slope(k, k) = -length;
        for (std::int64_t j = k + 1; j < equations_; ++j) row_[j] = at(k, j);
        for (std::int64_t i = k + 1; i < unknowns_; ++i) {
            const double own = v[i];
            const double* line = matrix_.data() + i * equations_;
            for (std::int64_t j = k + 1; j < equations_; ++j) row_[j] += own * line[j];
        }
        for (std::int64_t j = k + 1; j < equations_; ++j) row_[j] *= shares_[k];
        for (std::int64_t j = k + 1; j < equations_; ++j) slope(k, j) -= row_[j];
        for (std::int64_t i = k + 1; i < unknowns_; ++i) {
            const double own = v[i];
            double* line = matrix_.data() + i * equations_;
            for (std::int64_t j = k + 1; j < equations_; ++j) line[j] -= own * row_[j];
        }
    }

    void reflect(std::int64_t k, double* x) const {
        const double* v = reflectors_.data() + k * unknowns_;
        double sum = x[k];
        for (std::int64_t i = k + 1; i < unknowns_; ++i) sum += v[i] * x[i];
        sum *= shares_[k];
        x[k] -= sum;
        for (std::int64_t i = k + 1; i < unknowns_; ++i) x[i] -= sum * v[i];
    }

    void backward(double* x) const {
        for (std::int64_t k = equations_; k-- > 0;) reflect(k, x);
    }
};

// Steps of one factorisation, for the watch.
std::int64_t work(const Closing& closing) { return closing.unknowns() * closing.equations() * (closing.equations() + 8) / 4 + 50; }

}  // namespace

std::string fault(const Closing& closing) {
    for (std::int64_t j = 0; j < closing.joint_count; ++j) {
        const ClosedJoint& joint = closing.joints[j];
        if (joint.slides < 0 || joint.slides > 1) return "joint " + std::to_string(j) + " neither turns nor slides";
        for (int side = 0; side < 2; ++side) {
            if (joint.bodies[side] < 0 || joint.bodies[side] > closing.body_count)
                return "joint " + std::to_string(j) + " joins a body that is none";
            if (joint.at[side] < 0 || joint.at[side] > closing.size_count - 2 - joint.slides)
                return "joint " + std::to_string(j) + " lies at dimensions that are none";
        }
    }
    if (closing.body_count < 1) return "a linkage has a moving body";
    if (closing.equations() > closing.unknowns()) return "there are more equations than unknowns";
    return "";
}

bool close_poses(const Closing& closing, std::int64_t steps, double* q, std::uint8_t* reached, Watch& watch) {
    const std::int64_t unknowns = closing.unknowns();
    Pose pose(closing);
    std::vector<double> gaps(closing.equations()), room(unknowns);
    std::copy(closing.q, closing.q + closing.pose_count * unknowns, q);
    for (std::int64_t n = 0; n < closing.pose_count; ++n) {
        double* own = q + n * unknowns;
        reached[n] = 0;
        for (std::int64_t step = 0; step < steps; ++step) {
            pose.join(own);
            const double most = pose.gaps(gaps.data());
            reached[n] = most < reached_at * closing.size;
            if (reached[n] || !std::isfinite(most)) break;
            pose.factor();
            pose.correct(gaps.data(), own, room.data());
            if (!spend(watch, work(closing))) return false;
        }
    }
    return true;
}

bool pose_slopes(const Closing& closing, double* by_pose, double* by_sizes, Watch& watch) {
    const std::int64_t unknowns = closing.unknowns(), equations = closing.equations();
    Pose pose(closing);
    for (std::int64_t n = 0; n < closing.pose_count; ++n) {
        pose.join(closing.q + n * unknowns);
        pose.slopes(by_pose + n * equations * unknowns, by_sizes + n * equations * closing.size_count);
        if (!spend(watch, equations * (unknowns + closing.size_count))) return false;
    }
    return true;
}

bool move_poses(const Closing& closing, double* motion, Watch& watch) {
    const std::int64_t unknowns = closing.unknowns();
    Pose pose(closing);
    std::vector<double> room(unknowns);
    for (std::int64_t n = 0; n < closing.pose_count; ++n) {
        pose.join(closing.q + n * unknowns);
        pose.factor();
        pose.motion(motion + n * unknowns * closing.freedoms(), room.data());
        if (!spend(watch, work(closing))) return false;
    }
    return true;
}

bool pose_gradients(const Closing& closing, std::int64_t quantities, const double* by_pose, double* gradients, Watch& watch) {
    const std::int64_t unknowns = closing.unknowns();
    Pose pose(closing);
    std::vector<double> room(unknowns);
    for (std::int64_t n = 0; n < closing.pose_count; ++n) {
        pose.join(closing.q + n * unknowns);
        pose.factor();
        for (std::int64_t k = n * quantities; k < (n + 1) * quantities; ++k) {
            pose.gradient(by_pose + k * unknowns, gradients + k * closing.size_count, room.data());
            if (!spend(watch, unknowns * closing.equations())) return false;
        }
        if (!spend(watch, work(closing))) return false;
    }
    return true;
}

}  // namespace gruebler::design
