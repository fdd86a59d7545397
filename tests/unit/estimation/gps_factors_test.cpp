/** Positions and headings as factors. */
#include <gtest/gtest.h>

#include "../../support/factor_jacobians.h"
#include "../../support/random_inputs.h"
#include "rgbd_graphslam/estimation/heading_increment.h"
#include "rgbd_graphslam/estimation/position_measurement.h"

namespace rgbd_graphslam {
namespace {

States someStates(RandomInputs& random, double tilt) {
    States states;
    for (int i = 0; i < 2; ++i) {
        const Eigen::Vector3d w = tilt * random.vector(1) + Eigen::Vector3d(0, 0, 2.5);
        KeyframeState state;
        state.T_body_world = SE3(rotationExp(w), random.vector(5));
        state.motion.gyro_bias = random.vector(0.1);
        states.keyframes.push_back(state);
    }
    return states;
}

TEST(PositionMeasurement, residualIsTheAntennaSDistance) {
    RandomInputs random(1);
    const States states = someStates(random, 1);
    const Eigen::Vector3d lever(0.3, -0.2, 1);
    const Eigen::Vector3d antenna = states.keyframes[1].T_body_world.inverse() * lever;
    const PositionMeasurement factor(1, antenna + Eigen::Vector3d(2, 0, -3), {2, 1, 3}, lever);
    FactorEvaluation evaluation(factor);
    ASSERT_TRUE(evaluation.evaluate(states, false));
    EXPECT_LT((evaluation.residual() - Eigen::Vector3d(1, 0, -1)).norm(), 1e-12);
}

TEST(PositionMeasurement, derivatives) {
    RandomInputs random(2);
    for (int i = 0; i < 10; ++i) {
        const PositionMeasurement factor(0, random.vector(10), {0.5, 1, 2}, random.vector(2));
        expectJacobiansMatch(factor, someStates(random, 1));
    }
}

TEST(HeadingIncrement, residualTakesTheBiasOff) {
    States states;
    states.keyframes.resize(2);
    states.keyframes[1].T_body_world.R = rotationExp({0, 0, -0.5});  // turned left by 0.5
    states.keyframes[0].motion.gyro_bias.z() = 0.02;
    const HeadingIncrement factor(0, 1, 0.5 + 0.02 * 3, 3, 0.01, 0);
    FactorEvaluation evaluation(factor);
    ASSERT_TRUE(evaluation.evaluate(states, false));
    EXPECT_NEAR(evaluation.residual()(0), 0, 1e-9);
}

TEST(HeadingIncrement, derivatives) {
    RandomInputs random(3);
    for (int i = 0; i < 10; ++i) {
        const HeadingIncrement factor(0, 1, 0.1, 0.7, 0.02, 1);
        expectJacobiansMatch(factor, someStates(random, 0.2));
    }
}

}  // namespace
}  // namespace rgbd_graphslam
