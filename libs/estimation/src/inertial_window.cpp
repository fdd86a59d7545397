#include "rgbd_graphslam/estimation/inertial_window.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "rgbd_graphslam/estimation/factor_evaluation.h"
#include "rgbd_graphslam/estimation/pose_prior.h"

namespace rgbd_graphslam {
namespace {

using Eigen::Vector3d;

constexpr int size = 18, motion_at = 6, gravity_at = 15;

/** Where a state's tangent vector is in that of two nodes. */
int offset(const StateKey& key) {
    const int within = key.kind == StateKind::Pose     ? 0
                       : key.kind == StateKind::Motion ? motion_at
                                                       : gravity_at;
    return key.index * size + within;
}

States statesOf(const InertialState& first, const InertialState& second) {
    return {{first.body, second.body}, {first.gravity, second.gravity}};
}

/** Normal equations of the states of two nodes. */
struct PairEquations {
    Eigen::Matrix<double, 2 * size, 2 * size> H = Eigen::Matrix<double, 2 * size, 2 * size>::Zero();
    Eigen::Matrix<double, 2 * size, 1> g = Eigen::Matrix<double, 2 * size, 1>::Zero();

    void add(const Factor& factor, const States& states) {
        FactorEvaluation evaluation(factor);
        if (!evaluation.evaluate(states, true)) return;
        const Eigen::VectorXd& r = evaluation.residual();
        const double weight = factor.kernel()(r.squaredNorm()).weight;
        const auto& keys = evaluation.keys();
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const Eigen::MatrixXd Ji = weight * evaluation.jacobian(static_cast<int>(i));
            g.segment(offset(keys[i]), Ji.cols()) += Ji.transpose() * r;
            for (std::size_t j = 0; j < keys.size(); ++j) {
                const Eigen::MatrixXd Jj = evaluation.jacobian(static_cast<int>(j));
                H.block(offset(keys[i]), offset(keys[j]), Ji.cols(), Jj.cols()) +=
                    Ji.transpose() * Jj;
            }
        }
    }

    void addGravityWalk(const Vector3d& change, double variance) {
        const double weight = 1 / variance;
        const Eigen::Matrix3d W = weight * Eigen::Matrix3d::Identity();
        H.block<3, 3>(gravity_at, gravity_at) += W;
        H.block<3, 3>(size + gravity_at, size + gravity_at) += W;
        H.block<3, 3>(gravity_at, size + gravity_at) -= W;
        H.block<3, 3>(size + gravity_at, gravity_at) -= W;
        g.segment<3>(gravity_at) -= weight * change;
        g.segment<3>(size + gravity_at) += weight * change;
    }
};

void addStrength(const Vector3d& gravity, double strength, double sigma, Matrix18d& H,
                 Vector18d& g) {
    const double norm = std::max(1e-3, gravity.norm()), weight = 1 / (sigma * sigma);
    const Vector3d direction = gravity / norm;
    H.block<3, 3>(gravity_at, gravity_at) += weight * direction * direction.transpose();
    g.segment<3>(gravity_at) += weight * (norm - strength) * direction;
}

Matrix18d symmetric(const Matrix18d& m) {
    return 0.5 * (m + m.transpose());
}

}  // namespace

InertialState InertialState::retract(const Vector18d& delta) const {
    return {body.retract(Vector15d(delta.head<15>())), gravity + delta.tail<3>()};
}

Vector18d InertialState::minus(const InertialState& other) const {
    Vector18d delta;
    delta << body.minus(other.body), gravity - other.gravity;
    return delta;
}

InertialState InertialState::in(const SE3& T_new_world) const {
    InertialState moved = *this;
    moved.body.T_body_world = body.T_body_world * T_new_world.inverse();
    moved.body.motion.velocity = T_new_world.R * body.motion.velocity;
    moved.gravity = T_new_world.R * gravity;
    return moved;
}

/** H delta = -g, block tridiagonal. */
struct InertialWindow::NormalEquations {
    std::vector<Matrix18d> diagonal, above;
    std::vector<Vector18d> g;

    /** Eliminates block after block. \return the solution */
    std::vector<Vector18d> solve(Matrix18d& last_covariance) {
        const std::size_t n = diagonal.size();
        std::vector<Eigen::LLT<Matrix18d>> factors;
        for (std::size_t i = 0; i < n; ++i) {
            factors.emplace_back(diagonal[i]);
            if (i + 1 < n) eliminate(factors.back(), i);
        }
        last_covariance = factors.back().solve(Matrix18d(Matrix18d::Identity()));
        std::vector<Vector18d> delta(n);
        for (std::size_t i = n; i-- > 0;) {
            Vector18d right = -g[i];
            if (i + 1 < n) right -= above[i] * delta[i + 1];
            delta[i] = factors[i].solve(right);
        }
        return delta;
    }

    void eliminate(const Eigen::LLT<Matrix18d>& factor, std::size_t i) {
        const Matrix18d carried = factor.solve(above[i]).transpose();
        diagonal[i + 1] = symmetric(diagonal[i + 1] - carried * above[i]);
        g[i + 1] -= carried * g[i];
    }
};

void InertialWindow::start(double stamp_s, const InertialState& state, const Vector18d& sigma) {
    restore({state, Matrix18d(sigma.cwiseInverse().cwiseAbs2().asDiagonal())},
            {{stamp_s, state, std::nullopt, {}}}, Matrix18d(sigma.cwiseAbs2().asDiagonal()));
}

void InertialWindow::restore(const Prior& prior, std::vector<Node> nodes,
                             const Matrix18d& covariance) {
    prior_ = prior;
    nodes_ = std::move(nodes);
    covariance_ = covariance;
}

void InertialWindow::add(Node node, std::vector<std::shared_ptr<const Factor>> links,
                         const Matrix18d& covariance) {
    nodes_.back().links = std::move(links);
    nodes_.push_back(std::move(node));
    covariance_ = covariance;
}

void InertialWindow::link(std::size_t node, std::shared_ptr<const Factor> factor) {
    nodes_[node].links.push_back(std::move(factor));
}

/** Of the first nodes. */
InertialWindow::NormalEquations InertialWindow::linearized(std::size_t count) const {
    NormalEquations equations;
    equations.diagonal.assign(count, Matrix18d::Zero());
    equations.above.assign(count, Matrix18d::Zero());
    equations.g.assign(count, Vector18d::Zero());
    equations.diagonal[0] = prior_.information;
    equations.g[0] = prior_.information * nodes_[0].state.minus(prior_.mean);
    for (std::size_t i = 0; i < count; ++i) {
        const Node& node = nodes_[i];
        addStrength(node.state.gravity, gravity_.strength, gravity_.strength_sigma,
                    equations.diagonal[i], equations.g[i]);
        const Node& next = nodes_[std::min(i + 1, count - 1)];
        const States states = statesOf(node.state, next.state);
        PairEquations pair;
        if (node.measured) {
            pair.add(PosePrior(0, node.measured->T_body_world, node.measured->information), states);
        }
        if (i + 1 < count) {
            for (const auto& factor : node.links) pair.add(*factor, states);
            pair.addGravityWalk(next.state.gravity - node.state.gravity,
                                gravity_.walk * gravity_.walk * (next.stamp_s - node.stamp_s));
            equations.diagonal[i + 1] += pair.H.bottomRightCorner<size, size>();
            equations.g[i + 1] += pair.g.tail<size>();
            equations.above[i] = pair.H.topRightCorner<size, size>();
        }
        equations.diagonal[i] += pair.H.topLeftCorner<size, size>();
        equations.g[i] += pair.g.head<size>();
    }
    return equations;
}

double InertialWindow::optimize(int iterations) {
    constexpr double converged = 0.01;
    double moved = 0;
    for (int i = 0; i < iterations; ++i) {
        NormalEquations equations = linearized(nodes_.size());
        const std::vector<Vector18d> delta = equations.solve(covariance_);
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            nodes_[n].state = nodes_[n].state.retract(delta[n]);
        }
        moved =
            delta.back().cwiseQuotient(covariance_.diagonal().cwiseSqrt()).cwiseAbs().maxCoeff();
        if (moved < converged) break;
    }
    return moved;
}

void InertialWindow::marginalize(std::size_t keep) {
    while (nodes_.size() > std::max<std::size_t>(1, keep)) {
        NormalEquations equations = linearized(2);
        // What the second node measured by itself stays with it.
        InertialWindow alone(gravity_);
        alone.nodes_ = {nodes_[1]};
        alone.prior_ = {nodes_[1].state, Matrix18d::Zero()};
        const NormalEquations own = alone.linearized(1);
        equations.eliminate(Eigen::LLT<Matrix18d>(equations.diagonal[0]), 0);
        prior_.information = symmetric(equations.diagonal[1] - own.diagonal[0]);
        const Vector18d g = equations.g[1] - own.g[0];
        prior_.mean = nodes_[1].state.retract(-prior_.information.fullPivLu().solve(g));
        nodes_.erase(nodes_.begin());
    }
}

void InertialWindow::transform(const SE3& T_new_world) {
    for (Node& node : nodes_) {
        node.state = node.state.in(T_new_world);
        if (node.measured) {
            node.measured->T_body_world = node.measured->T_body_world * T_new_world.inverse();
        }
    }
    prior_.mean = prior_.mean.in(T_new_world);
    Matrix18d turn = Matrix18d::Identity();
    turn.block<3, 3>(motion_at, motion_at) = T_new_world.R;
    turn.block<3, 3>(gravity_at, gravity_at) = T_new_world.R;
    prior_.information = symmetric(turn * prior_.information * turn.transpose());
    covariance_ = symmetric(turn * covariance_ * turn.transpose());
}

Propagation propagationOf(const InertialState& state, const InertialState& next,
                          const Factor& factor, double gravity_walk) {
    FactorEvaluation evaluation(factor);
    evaluation.evaluate(statesOf(state, next), true);
    Eigen::Matrix<double, 15, size> by_from;
    by_from << evaluation.jacobian(0), evaluation.jacobian(1), evaluation.jacobian(4);
    Eigen::Matrix<double, 15, 15> by_to;
    by_to << evaluation.jacobian(2), evaluation.jacobian(3);
    const Eigen::Matrix<double, 15, 15> back = by_to.inverse();
    Propagation result;
    result.F.topRows<15>() = -back * by_from;
    result.Q.topLeftCorner<15, 15>() = back * back.transpose();
    result.Q.diagonal().tail<3>().array() += gravity_walk;
    return result;
}

InertialState carriedOn(const InertialState& state, const ImuIncrement& increment,
                        const SE3& T_imu_body) {
    const MotionState& motion = state.body.motion;
    const ImuIncrement moved = increment.corrected({motion.gyro_bias, motion.accelerometer_bias});
    const SE3 T_world_imu = (T_imu_body * state.body.T_body_world).inverse();
    const double dt = increment.duration_s;
    const SE3 T_world_next(
        orthonormalized(T_world_imu.R * moved.T_from_to.R),
        T_world_imu * moved.T_from_to.t + motion.velocity * dt + 0.5 * dt * dt * state.gravity);
    InertialState next = state;
    next.body.T_body_world = (T_world_next * T_imu_body).inverse();
    next.body.motion.velocity += state.gravity * dt + T_world_imu.R * moved.velocity;
    return next;
}

}  // namespace rgbd_graphslam
