#include "rgbd_graphslam/geometry/se3.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rgbd_graphslam/geometry/camera.h"

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

TEST(Camera, undistortInvertsDistortOverTheWholeImage) {
    Camera camera;
    camera.fx = 517.3, camera.fy = 516.5, camera.cx = 318.6, camera.cy = 255.3;
    camera.distortion = {0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
    for (double u = 0; u < camera.width; u += 40) {
        for (double v = 0; v < camera.height; v += 40) {
            const Eigen::Vector2d seen(u, v);
            EXPECT_LT((camera.distort(camera.undistort(seen)) - seen).norm(), 0.01);
        }
    }
}

}  // namespace
}  // namespace rgbd_graphslam
