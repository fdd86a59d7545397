#include "rgbd_graphslam/slam/keypoint_measurement.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

TEST(KeypointMeasurement, weighsDepthByTheNoiseModel) {
    SensorOptions sensor;
    const double z = 3.0, sigma = sensor.depth_noise.sigma(z);
    const Measurement m = measurementOf({320, 240, static_cast<float>(z), 0, 0}, 1, sensor);
    const double whitened = residual(Camera{}, {0, 0, z + sigma}, m).z();
    EXPECT_NEAR(std::abs(whitened), 1.0, 0.02) << "one sigma in depth is a residual of one";
}

TEST(KeypointMeasurement, weighsPixelsByTheirOctaveAndAlignment) {
    const SensorOptions sensor;
    Keypoint keypoint{320, 240, 0, 0, 2};
    EXPECT_DOUBLE_EQ(measurementOf(keypoint, 1.5, sensor).weight_px,
                     1 / (1.5 * sensor.keypoint_sigma_px));
    keypoint.aligned = true;
    EXPECT_DOUBLE_EQ(measurementOf(keypoint, 1.5, sensor).weight_px,
                     1 / (1.5 * sensor.aligned_sigma_px));
}

TEST(KeypointMeasurement, withoutDepthHasNoWeightOfDepth) {
    EXPECT_EQ(measurementOf({320, 240, 0, 0, 0}, 1, SensorOptions{}).weight_depth, 0);
}

}  // namespace
}  // namespace rgbd_graphslam
