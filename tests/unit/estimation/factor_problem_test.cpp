#include "../../../libs/estimation/src/factor_problem.h"

#include <ceres/loss_function.h>
#include <gtest/gtest.h>

#include "../../support/random_inputs.h"
#include "rgbd_graphslam/estimation/relative_pose.h"

namespace rgbd_graphslam {
namespace {

TEST(FactorProblem, lossesAreTheKernels) {
    RandomInputs random(1);
    for (const KernelShape shape :
         {KernelShape::Huber, KernelShape::Cauchy, KernelShape::GemanMcClure}) {
        for (int i = 0; i < 200; ++i) {
            const RobustKernel kernel{shape, random.uniform(1, 10)};
            const double chi2 = kernel.limit * random.uniform(0.01, 50), h = 1e-5 * chi2;
            if (std::abs(chi2 - kernel.limit) < 2 * h) continue;
            double rho[3];
            lossOf(kernel)->Evaluate(chi2, rho);
            EXPECT_NEAR(rho[0], kernel(chi2).cost, 1e-9 * chi2);
            EXPECT_NEAR(rho[1], kernel(chi2).weight, 1e-12);
            const double curvature = (kernel(chi2 + h).weight - kernel(chi2 - h).weight) / (2 * h);
            EXPECT_NEAR(rho[2], curvature, 1e-6);
        }
    }
    EXPECT_FALSE(lossOf({}));
}

TEST(FactorProblem, evaluatesTheFactorsItIsGiven) {
    RandomInputs random(2);
    const States states{{{random.pose(), {}}, {random.pose(), {}}}, {}};
    const SE3 measured = random.pose();
    const RelativePose factor(0, 1, measured, 4 * Matrix6d::Identity());
    FactorProblem problem(states);
    problem.add(factor);
    problem.hold(0);
    double cost = 0;
    problem.problem().Evaluate({}, &cost, nullptr, nullptr, nullptr);
    const SE3 predicted =
        states.keyframes[0].T_body_world * states.keyframes[1].T_body_world.inverse();
    EXPECT_NEAR(cost, 0.5 * 4 * relativePoseError(predicted, measured).squaredNorm(), 1e-9 * cost);
    EXPECT_EQ(problem.keyframe(1).T_body_world.R, states.keyframes[1].T_body_world.R);
    EXPECT_EQ(problem.keyframe(1).T_body_world.t, states.keyframes[1].T_body_world.t);
}

}  // namespace
}  // namespace rgbd_graphslam
