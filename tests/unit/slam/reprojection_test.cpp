#include "rgbd_graphslam/slam/reprojection.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

TEST(Reprojection, jacobianEqualsNumericDifferentiation) {
    const Camera camera;
    Keypoint keypoint{320, 200, 2.1f, 0, 2};
    const Measurement m = measurementOf(keypoint, 1.5, SensorOptions{});
    const Eigen::Vector3d p(0.3, -0.2, 2.0);
    const Eigen::Matrix3d analytic = residualJacobian(camera, p, m);
    for (int i = 0; i < 3; ++i) {
        const double h = 1e-6;
        const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(i);
        const Eigen::Vector3d numeric =
            (residual(camera, p + step, m) - residual(camera, p - step, m)) / (2 * h);
        EXPECT_LT((analytic.col(i) - numeric).norm(), 1e-5 * analytic.norm());
    }
}

TEST(Reprojection, weighsDepthByTheNoiseModel) {
    SensorOptions sensor;
    const double z = 3.0, sigma = sensor.depth_noise.sigma(z);
    const Measurement m = measurementOf({320, 240, static_cast<float>(z), 0, 0}, 1, sensor);
    const double whitened = residual(Camera{}, {0, 0, z + sigma}, m).z();
    EXPECT_NEAR(std::abs(whitened), 1.0, 0.02) << "one sigma in depth is a residual of one";
}

TEST(Reprojection, withoutDepthThereIsNoThirdResidual) {
    const Measurement m = measurementOf({320, 240, 0, 0, 0}, 1, SensorOptions{});
    EXPECT_EQ(residual(Camera{}, {0.1, 0, 3}, m).z(), 0);
}

}  // namespace
}  // namespace rgbd_graphslam
