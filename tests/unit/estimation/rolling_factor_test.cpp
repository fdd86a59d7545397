#include "rgbd_graphslam/estimation/rolling_factor.h"

#include <gtest/gtest.h>

#include "../../support/factor_jacobians.h"
#include "../../support/random_inputs.h"

namespace rgbd_graphslam {
namespace {

const SE3 T_base_body(rotationExp({0.3, -1.2, 0.8}), {0.1, -0.05, 0.2});

TEST(RollingFactor, jacobiansMatch) {
    RandomInputs random(1);
    for (int i = 0; i < 50; ++i) {
        const States states{{{random.pose(), {}}, {random.pose(), {}}}, {}};
        expectJacobiansMatch(RollingFactor(0, 1, 0.01, T_base_body), states);
    }
}

TEST(RollingFactor, allowsAnyMotionInTheBasesPlaneOnARamp) {
    const SE3 T_world_base(rotationExp({0.1, -0.2, 0.7}), {1, 2, 3});
    const SE3 moved(rotationExp({0, 0, 0.4}), {0.3, -0.1, 0}),
        lifted(Eigen::Matrix3d::Identity(), {0, 0, 0.02});
    const auto body = [&](const SE3& pose) {
        return KeyframeState{(pose * T_base_body).inverse(), {}};
    };
    const RollingFactor factor(0, 1, 0.01, T_base_body);
    FactorEvaluation evaluation(factor);
    evaluation.evaluate({{body(T_world_base), body(T_world_base * moved)}, {}}, false);
    EXPECT_NEAR(evaluation.residual()[0], 0, 1e-9);
    evaluation.evaluate({{body(T_world_base), body(T_world_base * moved * lifted)}, {}}, false);
    EXPECT_NEAR(evaluation.residual()[0], 2, 1e-9) << "standard deviations";
}

}  // namespace
}  // namespace rgbd_graphslam
