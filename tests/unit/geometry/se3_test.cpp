#include "rgbd_graphslam/geometry/se3.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rgbd_graphslam {
namespace {

TEST(SE3, logInvertsExp) {
    for (const double angle : {0.0, 1e-10, 1e-4, 0.7, 3.0}) {
        const Eigen::Vector3d w = angle * Eigen::Vector3d(0.6, -0.48, 0.64);
        EXPECT_LT((rotationLog(rotationExp(w)) - w).norm(), 1e-9) << angle;
    }
}

TEST(SE3, retractInvertsMinus) {
    const SE3 a(rotationExp({0.3, -0.2, 0.9}), {1, 2, 3}),
        b(rotationExp({-0.5, 0.1, 0.2}), {0, 1, 5});
    const SE3 c = a.retract(b.minus(a));
    // minus() keeps the translation of the product, retract() adds it: equal by construction.
    EXPECT_LT((c.R - b.R).norm(), 1e-12);
    EXPECT_LT((c.t - b.t).norm(), 1e-12);
}

TEST(SE3, perturbationJacobianOfAPointIsIdentityAndMinusSkew) {
    const SE3 T(rotationExp({0.3, -0.2, 0.9}), {1, 2, 3});
    const Eigen::Vector3d p(0.5, -0.3, 2), q = T * p;
    Eigen::Matrix<double, 3, 6> analytic, numeric;
    analytic << Eigen::Matrix3d::Identity(), -skew(q);
    for (int i = 0; i < 6; ++i) {
        const double h = 1e-6;
        numeric.col(i) =
            (T.retract(h * Vector6d::Unit(i)) * p - T.retract(-h * Vector6d::Unit(i)) * p) /
            (2 * h);
    }
    EXPECT_LT((analytic - numeric).norm(), 1e-8);
}

}  // namespace
}  // namespace rgbd_graphslam
