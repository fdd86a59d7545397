#include "rgbd_graphslam/estimation/motion_state_prior.h"

#include <gtest/gtest.h>

#include "../../support/factor_jacobians.h"
#include "../../support/random_inputs.h"

namespace rgbd_graphslam {
namespace {

TEST(MotionStatePrior, jacobianMatchesAndTheResidualIsInSigmas) {
    RandomInputs random(1);
    const MotionState prior{random.vector(1), random.vector(0.1), random.vector(0.1)};
    Vector9d sigma;
    sigma << 1, 2, 3, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6;
    const MotionStatePrior factor(0, prior, sigma);
    const States states{{{random.pose(), prior.retract(2 * sigma)}}, {}};
    expectJacobiansMatch(factor, states);
    FactorEvaluation evaluation(factor);
    ASSERT_TRUE(evaluation.evaluate(states, false));
    EXPECT_LT((evaluation.residual() - Vector9d::Constant(2)).norm(), 1e-12);
}

}  // namespace
}  // namespace rgbd_graphslam
