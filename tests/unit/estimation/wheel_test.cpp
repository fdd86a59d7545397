/** Wheel odometry, preintegrated and as a factor. */
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "../../support/factor_jacobians.h"
#include "../../support/problem_of.h"
#include "../../support/random_inputs.h"
#include "rgbd_graphslam/estimation/bundle_adjustment.h"
#include "rgbd_graphslam/estimation/wheel_factor.h"

namespace rgbd_graphslam {
namespace {

const WheelNoise noise;

/** A robot that winds its way. */
PlanarPose place(double s) {
    return {0.5 * s, 0.3 * std::sin(s), std::atan2(0.3 * std::cos(s), 0.5) + 3};
}

std::vector<WheelSample> samples(double to_s, double rate_hz = 50) {
    std::vector<WheelSample> all;
    for (int i = -1; i <= to_s * rate_hz + 1; ++i) {
        all.push_back({i / rate_hz, place(i / rate_hz)});
    }
    return all;
}

Eigen::Vector3d difference(const PlanarPose& b, const PlanarPose& a) {
    return {b.x - a.x, b.y - a.y, std::remainder(b.yaw - a.yaw, 2 * M_PI)};
}

SE3 lifted(const PlanarPose& p) {
    return {rotationExp({0, 0, p.yaw}), {p.x, p.y, 0}};
}

TEST(WheelPreintegration, givesTheMotionBetweenTwoMoments) {
    const auto increment = preintegrate(samples(3), 0.513, 2.487, noise);
    ASSERT_TRUE(increment);
    EXPECT_NEAR(increment->duration_s, 1.974, 1e-12);
    const PlanarPose expected = place(0.513).inverse() * place(2.487);
    EXPECT_LT(difference(increment->T_from_to, expected).norm(), 1e-3);
}

TEST(WheelPreintegration, refusesGapsAndWhatDoesNotReachTheEnds) {
    auto all = samples(2);
    EXPECT_FALSE(preintegrate(all, -1, 1, noise));
    EXPECT_FALSE(preintegrate(all, 1, 3, noise));
    all.erase(all.begin() + 40, all.begin() + 60);
    EXPECT_FALSE(preintegrate(all, 0, 2, noise));
    EXPECT_TRUE(preintegrate(all, 0, 0.5, noise));
}

TEST(WheelPreintegration, covarianceIsThatOfNoisyWheels) {
    constexpr int trials = 4000;
    RandomInputs random(1);
    const auto exact = samples(4);
    WheelNoise coarse;
    coarse.least_sigma_m = coarse.least_sigma_rad = 0;
    const auto expected = preintegrate(exact, 0, 4, coarse);
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (int t = 0; t < trials; ++t) {
        std::vector<WheelSample> noisy{exact.front()};
        for (std::size_t i = 1; i < exact.size(); ++i) {
            PlanarPose step = exact[i - 1].T_start_base.inverse() * exact[i].T_start_base;
            const double way = std::hypot(step.x, step.y), turn = std::abs(step.yaw);
            step.x += std::sqrt(coarse.forward_m2_per_m * way) * random.gauss();
            step.y += std::sqrt(coarse.sideways_m2_per_m * way) * random.gauss();
            step.yaw += std::sqrt(coarse.yaw_rad2_per_m * way + coarse.yaw_rad2_per_rad * turn) *
                        random.gauss();
            noisy.push_back({exact[i].stamp_s, noisy.back().T_start_base * step});
        }
        const Eigen::Vector3d d =
            difference(preintegrate(noisy, 0, 4, coarse)->T_from_to, expected->T_from_to);
        scatter += d * d.transpose() / trials;
    }
    EXPECT_NEAR(expected->covariance.llt().solve(scatter).trace() / 3, 1, 0.06);
}

TEST(WheelFactor, jacobiansMatch) {
    RandomInputs random(2);
    const SE3 T_base_body(rotationExp({0.5, -1, 0.3}), {0.2, 0.1, 0.5});
    for (int i = 0; i < 200; ++i) {
        const auto increment = preintegrate(samples(3), 0.5, random.uniform(1, 3), noise);
        const SE3 T_body_world = random.pose();
        const SE3 motion = lifted(increment->T_from_to).retract(random.tangent(0.5, 0.5));
        const SE3 T_to_world =
            (T_base_body.inverse() * motion.inverse() * T_base_body) * T_body_world;
        const States states{{{T_body_world, {}}, {T_to_world, {}}}, {}};
        expectJacobiansMatch(WheelFactor(0, 1, *increment, T_base_body), states, 1e-5);
    }
}

TEST(WheelFactor, leavesHeightRollAndPitchFree) {
    const auto increment = preintegrate(samples(3), 0, 2, noise);
    const WheelFactor factor(0, 1, *increment);
    const SE3 motion = lifted(increment->T_from_to);
    FactorEvaluation evaluation(factor);
    const SE3 climbs(rotationExp({0.05, 0, 0}), {0, 0, 0.3});
    ASSERT_TRUE(evaluation.evaluate({{{SE3(), {}}, {(motion * climbs).inverse(), {}}}, {}}, false));
    EXPECT_LT(evaluation.residual().norm(), 1e-6);
}

TEST(WheelFactor, aWindowFollowsTheWheelsWhereNothingIsSeen) {
    BundleProblem problem;
    problem.free_keyframes = 1;
    const auto increment = preintegrate(samples(3), 0, 2, noise);
    const SE3 motion = lifted(increment->T_from_to);
    RandomInputs random(3);
    const SE3 start = motion.inverse().retract(random.tangent(0.1, 0.1));
    problem.states.keyframes = {{start, {}}, {SE3(), {}}};
    problem.factors.push_back(std::make_shared<WheelFactor>(1, 0, *increment));
    adjustBundle(problem, 30, false);
    FactorEvaluation evaluation(*problem.factors[0]);
    ASSERT_TRUE(evaluation.evaluate(problem.states, false));
    EXPECT_LT(evaluation.residual().norm(), 1e-3);
}

TEST(WheelFactor, refusesAnIncrementOfNothing) {
    EXPECT_EQ(problemOf([&] { WheelFactor(3, 4, {}); }),
              "wheel edge 3 - 4: the information matrix is not positive definite; "
              "give it the inverse of a covariance");
}

}  // namespace
}  // namespace rgbd_graphslam
