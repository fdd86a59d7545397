#include "rgbd_graphslam/estimation/lie_jacobians.h"

#include <gtest/gtest.h>

#include "../../support/random_inputs.h"

namespace rgbd_graphslam {
namespace {

/** On (0, 3]; near pi the logarithm jumps. */
Eigen::Vector3d shortOfHalfATurn(RandomInputs& random) {
    return std::min(3.0, random.angle()) * random.direction();
}

TEST(LieJacobians, leftOneIsThatOfTheExponential) {
    RandomInputs random(5);
    constexpr double h = 1e-6;
    for (int i = 0; i < 500; ++i) {
        const Eigen::Vector3d w = shortOfHalfATurn(random);
        const Eigen::Matrix3d back = rotationExp(-w);
        Eigen::Matrix3d numeric;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
            numeric.col(k) = (rotationLog(rotationExp(w + step) * back) -
                              rotationLog(rotationExp(w - step) * back)) /
                             (2 * h);
        }
        EXPECT_LT((leftJacobian(w) - numeric).norm(), 1e-6) << w.norm();
    }
}

TEST(LieJacobians, inverseIsThatOfTheLogarithmByALeftPerturbation) {
    RandomInputs random(3);
    constexpr double h = 1e-6;
    for (int i = 0; i < 500; ++i) {
        const Eigen::Vector3d w = shortOfHalfATurn(random);
        Eigen::Matrix3d numeric;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
            numeric.col(k) = (rotationLog(rotationExp(step) * rotationExp(w)) -
                              rotationLog(rotationExp(-step) * rotationExp(w))) /
                             (2 * h);
        }
        EXPECT_LT((inverseLeftJacobian(w) - numeric).norm(), 1e-6) << w.norm();
    }
}

TEST(LieJacobians, areInversesAndContinuousAtZero) {
    const Eigen::Vector3d axis(0.6, -0.48, 0.64);
    for (const double angle : {1e-9, 0.99e-4, 1.01e-4, 1e-3, 0.5, 3.0}) {
        const Eigen::Matrix3d product =
            leftJacobian(angle * axis) * inverseLeftJacobian(angle * axis);
        EXPECT_LT((product - Eigen::Matrix3d::Identity()).norm(), 1e-7) << angle;
    }
    EXPECT_LT((inverseLeftJacobian(1.01e-4 * axis) - inverseLeftJacobian(0.99e-4 * axis)).norm(),
              1e-5);
    EXPECT_EQ(inverseLeftJacobian(Eigen::Vector3d::Zero()), Eigen::Matrix3d::Identity());
}

TEST(LieJacobians, theAdjointMovesAPerturbationAcrossATransform) {
    RandomInputs random(6);
    for (int i = 0; i < 200; ++i) {
        const SE3 T = random.pose(), pose = random.pose();
        const Vector6d delta = random.tangent(1e-5, 1e-5);
        const SE3 before = T * pose.retract(delta), after = (T * pose).retract(adjoint(T) * delta);
        EXPECT_LT(before.minus(after).norm(), 1e-8) << i;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
