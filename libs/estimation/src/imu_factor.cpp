#include "rgbd_graphslam/estimation/imu_factor.h"

#include <Eigen/LU>
#include <cmath>

#include "rgbd_graphslam/estimation/lie_jacobians.h"
#include "rgbd_graphslam/estimation/whitening.h"

namespace rgbd_graphslam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix156d = Eigen::Matrix<double, 15, 6>;
using Matrix159d = Eigen::Matrix<double, 15, 9>;
using Matrix153d = Eigen::Matrix<double, 15, 3>;

ImuBias biasOf(const MotionState& motion) {
    return {motion.gyro_bias, motion.accelerometer_bias};
}

/** What the states predict, in the sensor's frame at the first keyframe. */
struct Prediction {
    Prediction(const SE3& T_from_world, const MotionState& from, const SE3& T_to_world,
               const MotionState& to, const Vector3d& gravity, double dt)
        : R_from_world(T_from_world.R), R_from_to(T_from_world.R * T_to_world.R.transpose()) {
        const Vector3d way = T_to_world.inverse().t - T_from_world.inverse().t;
        position = R_from_world * (way - from.velocity * dt - 0.5 * dt * dt * gravity);
        velocity = R_from_world * (to.velocity - from.velocity - gravity * dt);
    }
    Matrix3d R_from_world, R_from_to;
    Vector3d position, velocity;
};

Vector15d errorOf(const Prediction& predicted, const ImuIncrement& measured,
                  const MotionState& from, const MotionState& to) {
    Vector15d error;
    error << predicted.position - measured.T_from_to.t,
        rotationLog(measured.T_from_to.R.transpose() * predicted.R_from_to),
        predicted.velocity - measured.velocity, to.gyro_bias - from.gyro_bias,
        to.accelerometer_bias - from.accelerometer_bias;
    return error;
}

Matrix156d byFirstPose(const Prediction& p, const Matrix3d& by_right_turn) {
    Matrix156d J = Matrix156d::Zero();
    J.block<3, 3>(0, 0) = Matrix3d::Identity();
    J.block<3, 3>(0, 3) = -skew(p.position);
    J.block<3, 3>(3, 3) = by_right_turn * p.R_from_to.transpose();
    J.block<3, 3>(6, 3) = -skew(p.velocity);
    return J;
}

Matrix156d bySecondPose(const Prediction& p, const Matrix3d& by_right_turn) {
    Matrix156d J = Matrix156d::Zero();
    J.block<3, 3>(0, 0) = -p.R_from_to;
    J.block<3, 3>(3, 3) = -by_right_turn;
    return J;
}

/** \param by_left_turn derivative of the rotation's error by a left perturbation of it
 *  \param turned by the change of bias since the preintegration, rad */
Matrix159d byFirstMotion(const Prediction& p, const ImuIncrement& increment,
                         const Matrix3d& by_left_turn, const Vector3d& turned) {
    Matrix159d J = Matrix159d::Zero();
    J.block<3, 3>(0, 0) = -p.R_from_world * increment.duration_s;
    J.block<3, 3>(6, 0) = -p.R_from_world;
    J.block<9, 6>(0, 3) = -increment.by_bias;
    J.block<3, 6>(3, 3) =
        -by_left_turn * leftJacobian(-turned) * increment.by_bias.middleRows<3>(3);
    J.bottomRightCorner<6, 6>() = -Matrix6d::Identity();
    return J;
}

Matrix159d bySecondMotion(const Prediction& p) {
    Matrix159d J = Matrix159d::Zero();
    J.block<3, 3>(6, 0) = p.R_from_world;
    J.bottomRightCorner<6, 6>() = Matrix6d::Identity();
    return J;
}

Matrix153d byGravity(const Prediction& p, double dt) {
    Matrix153d J = Matrix153d::Zero();
    J.block<3, 3>(0, 0) = -0.5 * dt * dt * p.R_from_world;
    J.block<3, 3>(6, 0) = -dt * p.R_from_world;
    return J;
}

}  // namespace

ImuFactor::ImuFactor(int from, int to, const ImuIncrement& increment,
                     const Eigen::Vector3d& gravity, const ImuNoise& noise, const SE3& T_imu_body)
    : from_(from), to_(to), increment_(increment), gravity_(gravity), T_imu_body_(T_imu_body) {
    whitening_.topLeftCorner<9, 9>() =
        whiteningOf(Matrix9d(increment.covariance.inverse()),
                    "inertial edge " + std::to_string(from) + " - " + std::to_string(to));
    const double root = std::sqrt(increment.duration_s);
    whitening_.diagonal().segment<3>(9).setConstant(1 / (noise.gyro_walk * root));
    whitening_.diagonal().tail<3>().setConstant(1 / (noise.accelerometer_walk * root));
}

std::vector<StateKey> ImuFactor::states() const {
    std::vector<StateKey> keys{poseKey(from_), motionKey(from_), poseKey(to_), motionKey(to_)};
    if (gravity_point_) keys.push_back(pointKey(*gravity_point_));
    return keys;
}

bool ImuFactor::linearize(const StateBlocks& states, Linearization& out) const {
    const MotionState from = states.motion(1), to = states.motion(3);
    const Prediction predicted(T_imu_body_ * states.pose(0), from, T_imu_body_ * states.pose(2), to,
                               gravity_point_ ? states.point(4) : gravity_, increment_.duration_s);
    const ImuIncrement measured = increment_.corrected(biasOf(from));
    const Vector15d error = errorOf(predicted, measured, from, to);
    out.setResidual(Vector15d(whitening_ * error));
    if (!out.wantsJacobians()) return true;
    const Matrix3d by_left_turn = inverseLeftJacobian(error.segment<3>(3));
    const Matrix3d by_right_turn = by_left_turn.transpose();
    const Vector3d turned = rotationLog(increment_.T_from_to.R.transpose() * measured.T_from_to.R);
    const Matrix6d by_body = adjoint(T_imu_body_);
    out.setJacobian(0, Matrix156d(whitening_ * byFirstPose(predicted, by_right_turn) * by_body));
    out.setJacobian(
        1, Matrix159d(whitening_ * byFirstMotion(predicted, increment_, by_left_turn, turned)));
    out.setJacobian(2, Matrix156d(whitening_ * bySecondPose(predicted, by_right_turn) * by_body));
    out.setJacobian(3, Matrix159d(whitening_ * bySecondMotion(predicted)));
    if (gravity_point_) {
        out.setJacobian(4, Matrix153d(whitening_ * byGravity(predicted, increment_.duration_s)));
    }
    return true;
}

}  // namespace rgbd_graphslam
