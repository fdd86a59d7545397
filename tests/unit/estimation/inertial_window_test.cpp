#include "rgbd_graphslam/estimation/inertial_window.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "../../support/factor_jacobians.h"
#include "../../support/random_inputs.h"
#include "rgbd_graphslam/estimation/imu_factor.h"
#include "ride.h"

namespace rgbd_graphslam {
namespace {

const SE3 T_imu_body(rotationExp({0.3, -1.2, 0.8}), {0.1, -0.05, 0.2});
const ImuNoise noise;
constexpr double interval_s = 0.2;

Ride biasedRide() {
    Ride ride;
    ride.bias.gyro_bias = {0.02, -0.01, 0.015};
    ride.bias.accelerometer_bias = {0.1, -0.05, 0.08};
    return ride;
}

std::shared_ptr<ImuFactor> link(const ImuIncrement& increment) {
    auto factor =
        std::make_shared<ImuFactor>(0, 1, increment, Eigen::Vector3d::Zero(), noise, T_imu_body);
    factor->estimateGravity(0);
    return factor;
}

InertialState truth(const Ride& ride, double s) {
    return {ride.state(s, T_imu_body), ride.gravity};
}

/** Drives a window along a ride whose poses are measured to 2 mm and 1 mrad.
 *  \param keep nodes after each step; 0 = all */
InertialWindow driven(const Ride& ride, int nodes, std::size_t keep, unsigned seed) {
    RandomInputs random(seed);
    const Matrix6d information =
        (Vector6d() << 2.5e5, 2.5e5, 2.5e5, 1e6, 1e6, 1e6).finished().asDiagonal();
    const auto measured = [&](double s) {
        Vector6d off;
        off << 0.002 * random.gauss(), 0.002 * random.gauss(), 0.002 * random.gauss(),
            0.001 * random.gauss(), 0.001 * random.gauss(), 0.001 * random.gauss();
        return MeasuredPose{truth(ride, s).body.T_body_world.retract(off), information};
    };
    InertialState start = truth(ride, 0);
    start.body.motion = {};
    start.gravity = {0.5, -0.3, -9.7};
    Vector18d sigma;
    sigma << Vector6d::Constant(1), Eigen::Vector3d::Constant(3), Eigen::Vector3d::Constant(0.1),
        Eigen::Vector3d::Constant(0.5), Eigen::Vector3d::Constant(3);
    InertialWindow window;
    window.start(0, start, sigma);
    window.measure(0, measured(0));
    for (int n = 1; n < nodes; ++n) {
        const double from_s = (n - 1) * interval_s, to_s = n * interval_s;
        const MotionState& known = window.nodes().back().state.body.motion;
        const auto increment = preintegrate(ride.samples(from_s, to_s), from_s, to_s,
                                            {known.gyro_bias, known.accelerometer_bias}, noise);
        const InertialState next = carriedOn(window.nodes().back().state, *increment, T_imu_body);
        window.add({to_s, next, measured(to_s), {}}, {link(*increment)}, window.covariance());
        window.optimize(3);
        if (keep > 0) window.marginalize(keep);
    }
    return window;
}

TEST(InertialWindow, theFactorsJacobiansMatchWithGravityUnknown) {
    RandomInputs random(1);
    const Ride ride = biasedRide();
    const auto increment = preintegrate(ride.samples(1, 1.5), 1, 1.5, {}, noise);
    States states{{ride.state(1, T_imu_body), ride.state(1.5, T_imu_body)}, {{0.5, -1, -9.6}}};
    for (KeyframeState& state : states.keyframes) {
        Vector15d off;
        off << random.tangent(0.3, 0.5), random.vector(0.5), random.vector(0.05),
            random.vector(0.2);
        state = state.retract(off);
    }
    expectJacobiansMatch(*link(*increment), states, 1e-5);
}

TEST(InertialWindow, findsVelocityBiasesAndGravity) {
    const Ride ride = biasedRide();
    const InertialWindow window = driven(ride, 50, 10, 3);
    const Vector18d off = window.nodes().back().state.minus(truth(ride, 49 * interval_s));
    EXPECT_LT(off.segment<3>(6).norm(), 0.01) << "velocity, m/s";
    EXPECT_LT(off.segment<3>(9).norm(), 5e-4) << "gyro bias, rad/s";
    EXPECT_LT(off.segment<3>(12).norm(), 0.02) << "accelerometer bias, m/s^2";
    EXPECT_LT(off.tail<3>().norm(), 0.02) << "gravity, m/s^2";
}

TEST(InertialWindow, marginalizingLosesNothing) {
    const Ride ride = biasedRide();
    const InertialWindow all = driven(ride, 25, 0, 4), last = driven(ride, 25, 5, 4);
    ASSERT_EQ(last.nodes().size(), 5u);
    const Vector18d off = last.nodes().back().state.minus(all.nodes().back().state);
    const Vector18d sigma = all.covariance().diagonal().cwiseSqrt();
    EXPECT_LT(off.cwiseQuotient(sigma).cwiseAbs().maxCoeff(), 0.2) << "standard deviations";
    EXPECT_LT((last.covariance().diagonal().cwiseSqrt() - sigma)
                  .cwiseQuotient(sigma)
                  .cwiseAbs()
                  .maxCoeff(),
              0.05);
}

TEST(InertialWindow, isAsUncertainAsItIsWrong) {
    const Ride ride = biasedRide();
    double poses = 0, motions = 0;
    constexpr int runs = 40;
    for (unsigned seed = 0; seed < runs; ++seed) {
        const InertialWindow window = driven(ride, 20, 8, 100 + seed);
        const Vector18d off = window.nodes().back().state.minus(truth(ride, 19 * interval_s));
        const Matrix18d& P = window.covariance();
        poses += off.head<6>().dot(P.topLeftCorner<6, 6>().inverse() * off.head<6>()) / (6 * runs);
        motions +=
            off.segment<3>(6).dot(P.block<3, 3>(6, 6).inverse() * off.segment<3>(6)) / (3 * runs);
    }
    // The readings are exact, so that the motion is known better than the window supposes.
    EXPECT_LT(poses, 1.5);
    EXPECT_GT(poses, 0.3);
    EXPECT_LT(motions, 1.5);
}

TEST(InertialWindow, doesNotCareWhichWorldItIsIn) {
    const SE3 T_new_world(rotationExp({0.4, 0.2, -1}), {3, -2, 1});
    InertialWindow moved = driven(biasedRide(), 12, 6, 5), still = moved;
    moved.transform(T_new_world);
    moved.optimize(2);
    still.optimize(2);
    const Vector18d off =
        moved.nodes().back().state.minus(still.nodes().back().state.in(T_new_world));
    EXPECT_LT(off.norm(), 1e-6);
}

TEST(InertialWindow, readingsLeadAlongTheRide) {
    Ride ride;
    const auto increment = preintegrate(ride.samples(1, 3), 1, 3, {}, noise);
    const InertialState next = carriedOn(truth(ride, 1), *increment, T_imu_body);
    const Vector18d off = next.minus(truth(ride, 3));
    EXPECT_LT(off.head<9>().norm(), 2e-3);
}

TEST(InertialWindow, propagatesErrorsAsTheyAre) {
    Ride ride;
    RandomInputs random(6);
    const auto increment = preintegrate(ride.samples(1, 1.4), 1, 1.4, {}, noise);
    const InertialState from = truth(ride, 1), to = carriedOn(from, *increment, T_imu_body);
    const Propagation carried = propagationOf(from, to, *link(*increment), 0);
    for (int axis = 0; axis < 18; ++axis) {
        const Vector18d off = 1e-5 * Vector18d::Unit(axis);
        const InertialState moved = carriedOn(from.retract(off), *increment, T_imu_body);
        EXPECT_LT((moved.minus(to) - carried.F * off).norm(), 1e-8) << "axis " << axis;
    }
    // What the readings add is the increment's own covariance, in other coordinates.
    const double added = carried.Q.block<3, 3>(3, 3).trace(),
                 measured = increment->covariance.block<3, 3>(3, 3).trace();
    EXPECT_NEAR(added, measured, 1e-9);
}

}  // namespace
}  // namespace rgbd_graphslam
