/** The Jacobians of every factor, and what the factors measure. */
#include <gtest/gtest.h>

#include "../../support/factor_jacobians.h"
#include "../../support/problem_of.h"
#include "measurements.h"
#include "rgbd_graphslam/estimation/point_observation.h"
#include "rgbd_graphslam/estimation/pose_prior.h"
#include "rgbd_graphslam/estimation/relative_pose.h"

namespace rgbd_graphslam {
namespace {

constexpr int trials = 200;

/** Off by up to 3 m and less than half a turn: at half a turn the logarithm jumps. */
SE3 someError(RandomInputs& random) {
    return {rotationExp(std::min(3.0, random.angle()) * random.direction()), random.vector(3)};
}

/** Of a covariance with correlations. */
Matrix6d someInformation(RandomInputs& random) {
    Matrix6d A;
    for (double& x : A.reshaped()) x = random.uniform(-1, 1);
    return A * A.transpose() + Matrix6d::Identity();
}

TEST(PointObservation, jacobiansMatchForACameraAnywhereOnTheBody) {
    RandomInputs random(1);
    for (int i = 0; i < trials; ++i) {
        const SE3 T_cam_body = i % 2 ? random.pose(0.5) : SE3();
        const MountedCamera camera(random.camera(), T_cam_body);
        States states;
        states.keyframes.push_back({random.pose(), {}});
        const Eigen::Vector3d p_cam(random.uniform(-1, 1), random.uniform(-1, 1),
                                    random.uniform(0.5, 5));
        states.points.push_back((T_cam_body * states.keyframes[0].T_body_world).inverse() * p_cam);
        const Measurement m = measurementOf(p_cam, camera.camera(), random, 3, i % 3 > 0);
        expectJacobiansMatch(PointObservation(camera, 0, 0, m), states);
    }
}

TEST(PointObservation, isNotDefinedBehindTheCamera) {
    const MountedCamera camera;
    const States states{{KeyframeState()}, {{0, 0, -1}}};
    const PointObservation factor(camera, 0, 0, measurementAt({320, 240}, 1));
    EXPECT_FALSE(FactorEvaluation(factor).evaluate(states, true));
}

TEST(PosePrior, jacobianMatches) {
    RandomInputs random(2);
    for (int i = 0; i < trials; ++i) {
        const SE3 prior = random.pose();
        const States states{{{someError(random) * prior, {}}}, {}};
        expectJacobiansMatch(PosePrior(0, prior, someInformation(random)), states, 1e-5);
    }
}

TEST(PosePrior, residualIsTheWhitenedTangentVector) {
    RandomInputs random(3);
    const SE3 prior = random.pose();
    const Vector6d delta = random.tangent(0.1, 0.1);
    const Matrix6d information = someInformation(random);
    const PosePrior factor(0, prior, information);
    FactorEvaluation evaluation(factor);
    ASSERT_TRUE(evaluation.evaluate({{{prior.retract(delta), {}}}, {}}, false));
    EXPECT_NEAR(evaluation.residual().squaredNorm(), delta.dot(information * delta), 1e-9);
}

TEST(RelativePose, jacobiansMatch) {
    RandomInputs random(4);
    for (int i = 0; i < trials; ++i) {
        const SE3 from = random.pose(), to = random.pose();
        const SE3 measured = from * to.inverse() * someError(random);
        const States states{{{from, {}}, {to, {}}}, {}};
        expectJacobiansMatch(RelativePose(0, 1, measured, someInformation(random)), states, 1e-5);
    }
}

TEST(RelativePose, isMetByThePosesItWasMeasuredOf) {
    RandomInputs random(5);
    const SE3 T_world_from = random.pose(), T_from_to = random.pose();
    const SE3 T_world_to = T_world_from * T_from_to;
    const States states{{{T_world_from.inverse(), {}}, {T_world_to.inverse(), {}}}, {}};
    const RelativePose factor(0, 1, T_from_to, Matrix6d::Identity());
    FactorEvaluation evaluation(factor);
    ASSERT_TRUE(evaluation.evaluate(states, false));
    EXPECT_LT(evaluation.residual().norm(), 1e-12);
}

TEST(Factors, refuseWhatIsNoInformationMatrix) {
    Matrix6d information = Matrix6d::Identity();
    information(2, 2) = -1;
    EXPECT_EQ(problemOf([&] { RelativePose(3, 4, SE3(), information); }),
              "edge 3 - 4: the information matrix is not positive definite; "
              "give it the inverse of a covariance");
    EXPECT_EQ(problemOf([&] { PosePrior(7, SE3(), information); }),
              "prior of keyframe 7: the information matrix is not positive definite; "
              "give it the inverse of a covariance");
}

}  // namespace
}  // namespace rgbd_graphslam
