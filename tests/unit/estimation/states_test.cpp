#include "rgbd_graphslam/estimation/states.h"

#include <gtest/gtest.h>

#include "../../support/random_inputs.h"

namespace rgbd_graphslam {
namespace {

KeyframeState someState(RandomInputs& random) {
    return {random.pose(), {random.vector(2), random.vector(0.1), random.vector(0.5)}};
}

Vector15d someTangent(RandomInputs& random) {
    Vector15d delta;
    delta << random.tangent(2, 1), random.vector(2), random.vector(0.1), random.vector(0.5);
    return delta;
}

TEST(KeyframeState, minusUndoesRetract) {
    RandomInputs random(1);
    for (int i = 0; i < 200; ++i) {
        const KeyframeState state = someState(random);
        const Vector15d delta = someTangent(random);
        EXPECT_LT((state.retract(delta).minus(state) - delta).norm(), 1e-12) << i;
        EXPECT_LT(state.minus(state).norm(), 1e-12) << i;
    }
}

TEST(KeyframeState, retractUndoesMinus) {
    RandomInputs random(2);
    for (int i = 0; i < 200; ++i) {
        const KeyframeState a = someState(random), b = someState(random);
        const KeyframeState again = a.retract(b.minus(a));
        EXPECT_LT((again.T_body_world.R - b.T_body_world.R).norm(), 1e-8) << i;
        EXPECT_LT((again.T_body_world.t - b.T_body_world.t).norm(), 1e-8) << i;
        EXPECT_LT(again.motion.minus(b.motion).norm(), 1e-12) << i;
    }
}

TEST(KeyframeState, sixNumbersMoveThePoseAlone) {
    RandomInputs random(3);
    const KeyframeState state = someState(random);
    const Vector6d delta = random.tangent(1, 1);
    const KeyframeState moved = state.retract(delta);
    EXPECT_EQ(moved.motion.minus(state.motion).norm(), 0);
    EXPECT_LT((moved.T_body_world.minus(state.T_body_world) - delta).norm(), 1e-12);
}

TEST(KeyframeState, aTranslationIsInTheBodysFrame) {
    KeyframeState state;
    state.T_body_world = SE3(rotationExp({0, 0, M_PI / 2}), {1, 2, 3}).inverse();
    const KeyframeState moved = state.retract(Vector6d(-Vector6d::Unit(0)));
    const Eigen::Vector3d place = moved.T_body_world.inverse().t;
    EXPECT_LT((place - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12) << "one meter along the body's x";
}

}  // namespace
}  // namespace rgbd_graphslam
