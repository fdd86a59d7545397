#include "rgbd_graphslam/estimation/reprojection.h"

#include <gtest/gtest.h>

#include "measurements.h"

namespace rgbd_graphslam {
namespace {

TEST(Reprojection, jacobianEqualsNumericDifferentiationForAnyCamera) {
    RandomInputs random(1);
    for (int i = 0; i < 500; ++i) {
        const Camera camera = random.camera();
        const auto somewhere = [&] {
            return Eigen::Vector2d(random.uniform(0, camera.width),
                                   random.uniform(0, camera.height));
        };
        const Measurement m = measurementAt(somewhere(), i % 4 ? random.uniform(0.3, 9) : 0);
        const Eigen::Vector2d pixel = somewhere();
        const Eigen::Vector3d p = camera.unproject(pixel.x(), pixel.y(), random.uniform(0.3, 9));
        const Eigen::Matrix3d analytic = residualJacobian(camera, p, m);
        const double h = 1e-5 * p.z();
        Eigen::Matrix3d numeric;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
            numeric.col(k) =
                (residual(camera, p + step, m) - residual(camera, p - step, m)) / (2 * h);
        }
        EXPECT_LT((analytic - numeric).norm(), 1e-7 * analytic.norm()) << i;
    }
}

TEST(Reprojection, oneSigmaInDepthIsAResidualOfOne) {
    const double z = 3.0, sigma = depth_noise.sigma(z);
    const Measurement m = measurementAt({320, 240}, z);
    EXPECT_NEAR(std::abs(residual(Camera{}, {0, 0, z + sigma}, m).z()), 1.0, 0.02);
}

TEST(Reprojection, withoutDepthThereIsNoThirdResidual) {
    EXPECT_EQ(residual(Camera{}, {0.1, 0, 3}, measurementAt({320, 240}, 0)).z(), 0);
}

TEST(Reprojection, aCameraOnTheBodySeesFromItsOwnPlace) {
    const SE3 T_cam_body(rotationExp({0, M_PI / 2, 0}), {0.1, 0.2, 0.3});
    const MountedCamera ahead{Camera{}}, aside(Camera{}, T_cam_body);
    const SE3 T_body_world(rotationExp({0.1, -0.2, 0.3}), {1, 2, 3});
    const Eigen::Vector3d point = (T_cam_body * T_body_world).inverse() * Eigen::Vector3d(0, 0, 2);
    const Measurement m = measurementAt({319.5, 239.5}, 2);
    EXPECT_TRUE(PointView(aside, T_body_world, point).fits(m));
    EXPECT_LT(PointView(aside, T_body_world, point).residual(m).norm(), 1e-9);
    EXPECT_FALSE(PointView(ahead, T_body_world, point).fits(m));
}

TEST(Reprojection, aPointBehindTheCameraFitsNothing) {
    const MountedCamera camera;
    const PointView view(camera, SE3(), {0, 0, -1});
    EXPECT_TRUE(view.tooNear());
    EXPECT_FALSE(view.fits(measurementAt({319.5, 239.5}, 0)));
}

}  // namespace
}  // namespace rgbd_graphslam
