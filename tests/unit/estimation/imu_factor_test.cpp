#include "rgbd_graphslam/estimation/imu_factor.h"

#include <gtest/gtest.h>

#include "../../support/factor_jacobians.h"
#include "../../support/problem_of.h"
#include "../../support/random_inputs.h"
#include "bundle.h"
#include "rgbd_graphslam/estimation/global_adjustment.h"
#include "rgbd_graphslam/estimation/motion_state_prior.h"
#include "rgbd_graphslam/estimation/pose_prior.h"
#include "ride.h"

namespace rgbd_graphslam {
namespace {

const SE3 T_imu_body(rotationExp({0.3, -1.2, 0.8}), {0.1, -0.05, 0.2});
const ImuNoise noise;

Ride biasedRide() {
    Ride ride;
    ride.bias.gyro_bias = {0.02, -0.01, 0.015};
    ride.bias.accelerometer_bias = {0.1, -0.05, 0.08};
    return ride;
}

ImuFactor between(const Ride& ride, int from, int to, double from_s, double to_s) {
    const auto increment = preintegrate(ride.samples(from_s, to_s), from_s, to_s, {}, noise);
    return ImuFactor(from, to, *increment, ride.gravity, noise, T_imu_body);
}

TEST(ImuFactor, jacobiansMatch) {
    RandomInputs random(1);
    const Ride ride = biasedRide();
    for (int i = 0; i < 50; ++i) {
        const double s = random.uniform(0, 5);
        States states{{ride.state(s, T_imu_body), ride.state(s + 0.5, T_imu_body)}, {}};
        for (KeyframeState& state : states.keyframes) {
            Vector15d off;
            off << random.tangent(0.3, 0.5), random.vector(0.5), random.vector(0.05),
                random.vector(0.2);
            state = state.retract(off);
        }
        expectJacobiansMatch(between(ride, 0, 1, s, s + 0.5), states, 1e-5);
    }
}

TEST(ImuFactor, isMetByTheRide) {
    const Ride ride = biasedRide();
    const States states{{ride.state(1, T_imu_body), ride.state(1.3, T_imu_body)}, {}};
    const auto increment = preintegrate(ride.samples(1, 1.3), 1, 1.3,
                                        {ride.bias.gyro_bias, ride.bias.accelerometer_bias}, noise);
    const ImuFactor factor(0, 1, *increment, ride.gravity, noise, T_imu_body);
    FactorEvaluation evaluation(factor);
    ASSERT_TRUE(evaluation.evaluate(states, false));
    EXPECT_LT(evaluation.residual().norm(), 0.01) << "in standard deviations";
}

TEST(ImuFactor, refusesAnIncrementOfNothing) {
    EXPECT_EQ(problemOf([&] {
                  ImuFactor(3, 4, {}, {0, 0, -9.81}, noise);
              }),
              "inertial edge 3 - 4: the information matrix is not positive definite; "
              "give it the inverse of a covariance");
}

/** Ten keyframes, a third of a second apart, whose poses are known to a millimeter and a
 *  milliradian; velocities and biases are unknown. */
BundleProblem window(const Ride& ride) {
    constexpr int keyframes = 10;
    constexpr double interval_s = 1.0 / 3;
    RandomInputs random(2);
    BundleProblem problem;
    problem.free_keyframes = keyframes;
    const Matrix6d information = 1e6 * Matrix6d::Identity();
    for (int k = 0; k < keyframes; ++k) {
        const SE3 pose = ride.state(k * interval_s, T_imu_body).T_body_world;
        problem.states.keyframes.push_back({pose.retract(random.tangent(0.05, 0.05)), {}});
        problem.factors.push_back(std::make_shared<PosePrior>(k, pose, information));
        if (k == 0) continue;
        problem.factors.push_back(std::make_shared<ImuFactor>(
            between(ride, k - 1, k, (k - 1) * interval_s, k * interval_s)));
    }
    Vector9d vague;
    vague << Eigen::Vector3d::Constant(10), Eigen::Vector3d::Constant(0.1),
        Eigen::Vector3d::Constant(1);
    problem.factors.push_back(std::make_shared<MotionStatePrior>(0, MotionState(), vague));
    return problem;
}

TEST(ImuFactor, aWindowFindsVelocitiesAndBiases) {
    const Ride ride = biasedRide();
    for (const auto& adjust : {adjustBundle, adjustBundleSparse}) {
        BundleProblem problem = window(ride);
        adjust(problem, 50, false);
        for (int k = 0; k < problem.free_keyframes; ++k) {
            const KeyframeState& found = problem.states.keyframes[k];
            const Vector15d error = found.minus(ride.state(k / 3.0, T_imu_body));
            EXPECT_LT(error.head<6>().norm(), 2e-3) << k;
            EXPECT_LT(error.segment<3>(6).norm(), 0.01) << "velocity " << k;
            EXPECT_LT(error.segment<3>(9).norm(), 1e-3) << "gyro bias " << k;
            EXPECT_LT(error.tail<3>().norm(), 0.02) << "accelerometer bias " << k;
        }
    }
}

TEST(ImuFactor, bridgesKeyframesThatNothingElseLocates) {
    const Ride ride = biasedRide();
    BundleProblem problem = window(ride);
    auto& factors = problem.factors;
    const auto locatesNinth = [](const std::shared_ptr<const Factor>& factor) {
        const auto keys = factor->states();
        return keys.size() == 1 && keys[0].kind == StateKind::Pose && keys[0].index == 8;
    };
    factors.erase(std::remove_if(factors.begin(), factors.end(), locatesNinth), factors.end());
    problem.states.keyframes[8] = problem.states.keyframes[7];
    adjustBundle(problem, 50, false);
    const Vector15d error = problem.states.keyframes[8].minus(ride.state(8 / 3.0, T_imu_body));
    EXPECT_LT(error.head<6>().norm(), 5e-3);
}

}  // namespace
}  // namespace rgbd_graphslam
