#include "rgbd_graphslam/synth/sensor_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <set>

namespace rgbd_graphslam::synth {
namespace {

struct Statistics {
    double mean = 0, deviation = 0, share_valid = 0;
};

Statistics wallReadings(double z) {
    const CameraModel camera;
    const cv::Mat wall(camera.height, camera.width, CV_32FC1, cv::Scalar(z));
    const cv::Mat readings = senseDepth(wall, camera, DepthSensorModel{}, Random(5));
    cv::Scalar mean, deviation;
    cv::meanStdDev(readings, mean, deviation, readings > 0);
    return {mean[0], deviation[0], cv::countNonZero(readings) / static_cast<double>(wall.total())};
}

class WallNoise : public testing::TestWithParam<double> {};

TEST_P(WallNoise, FollowsTheModel) {
    const double z = GetParam();
    const Statistics wall = wallReadings(z);
    const double step = z * z * 0.125 / (0.075 * 580);  // of the disparity
    EXPECT_NEAR(wall.deviation, DepthNoise{}.sigma(z), 0.12 * DepthNoise{}.sigma(z));
    EXPECT_NEAR(wall.mean, z, 0.1 * step + 2e-4 * z);
    EXPECT_GT(wall.share_valid, 0.98);
}
INSTANTIATE_TEST_SUITE_P(Distances, WallNoise, testing::Values(0.7, 1.0, 1.5, 2.0, 3.0, 3.9));

TEST(DepthSensor, DisparitiesAreQuantized) {
    const CameraModel camera = Intrinsics{320, 240, 262.5, 262.5, 159.5, 119.5, {}};
    const cv::Mat wall(240, 320, CV_32FC1, cv::Scalar(3.0));
    const cv::Mat readings = senseDepth(wall, camera, DepthSensorModel{}, Random(1));
    for (int u = 10; u < 300; ++u) {
        const double z = readings.at<float>(100, u);
        if (z == 0) continue;
        const double steps = 0.075 * 580 / z / 0.125;
        EXPECT_NEAR(steps, std::round(steps), 1e-4);
    }
}

TEST(DepthSensor, GivesNothingTooNearTooFarOrTooFlat) {
    EXPECT_EQ(wallReadings(0.4).share_valid, 0);
    EXPECT_EQ(wallReadings(5.2).share_valid, 0);
    const double fading = wallReadings(4.5).share_valid;
    EXPECT_GT(fading, 0.2);
    EXPECT_LT(fading, 0.8);

    // A floor 0.3 m below the camera is seen at 0.3 / z: too flat from 1.76 m on.
    const CameraModel camera;
    cv::Mat floor(camera.height, camera.width, CV_32FC1, cv::Scalar(0));
    const Intrinsics in = camera.intrinsics();
    for (int v = 300; v < camera.height; ++v) floor.row(v).setTo(0.3 * in.fy / (v - in.cy));
    const cv::Mat readings = senseDepth(floor, camera, DepthSensorModel{}, Random(1));
    const int flat_row = static_cast<int>(in.cy + 0.3 * in.fy / 2.2);
    const int steep_row = static_cast<int>(in.cy + 0.3 * in.fy / 1.0);
    EXPECT_EQ(cv::countNonZero(readings.row(flat_row)), 0);
    EXPECT_GT(cv::countNonZero(readings.row(steep_row)), 600);
}

TEST(DepthSensor, ShadowOfTheProjectorLiesLeftOfTheNearerThing) {
    const CameraModel camera;
    cv::Mat depth(camera.height, camera.width, CV_32FC1, cv::Scalar(3.0));
    depth.colRange(300, 400).setTo(1.0);
    const cv::Mat readings = senseDepth(depth, camera, DepthSensorModel{}, Random(2));
    const int shadow =
        static_cast<int>(0.075 * camera.pixelsPerRadian().x() * (1.0 / 1 - 1.0 / 3));  // 26 pixels
    EXPECT_LT(cv::countNonZero(readings.colRange(303 - shadow, 297)), 200);
    EXPECT_GT(cv::countNonZero(readings.colRange(403, 403 + shadow)), 0.95 * shadow * 479);
}

TEST(DepthUnits, AreFiveThousandAMetre) {
    const cv::Mat depth = (cv::Mat_<float>(1, 4) << 0, 1.00009, 2.5, 20);
    const cv::Mat units = toDepthUnits(depth);
    EXPECT_EQ(units.at<std::uint16_t>(0, 0), 0);
    EXPECT_EQ(units.at<std::uint16_t>(0, 1), 5000);
    EXPECT_EQ(units.at<std::uint16_t>(0, 2), 12500);
    EXPECT_EQ(units.at<std::uint16_t>(0, 3), 0);
}

TEST(ColorSensor, NoiseGrowsWithTheSignalAndTheGain) {
    const ColorSensorModel model;
    const auto deviation = [&](double level, double gain) {
        const cv::Mat gray(480, 640, CV_8UC3, cv::Scalar::all(level));
        cv::Scalar mean, spread;
        cv::meanStdDev(senseColor(gray, 1, gain, model, Random(1)), mean, spread);
        EXPECT_NEAR(mean[1], level, 0.6);
        return spread[1];
    };
    const auto expected = [&](double level) {
        return std::hypot(model.read_noise, model.shot_noise * std::sqrt(level));
    };
    for (double level : {40.0, 120.0, 200.0})
        EXPECT_NEAR(deviation(level, 1), std::hypot(expected(level), std::sqrt(1 / 12.0)), 0.05);
    EXPECT_GT(deviation(60, 4), 3 * deviation(60, 1) * std::sqrt(0.5));
}

TEST(FastNormal, HasTheMomentsOfANormal) {
    const FastNormal normal;
    Random random(1);
    double sum = 0, squares = 0, fourths = 0;
    const int count = 200000;
    for (int i = 0; i < count; ++i) {
        const double x = normal(random);
        sum += x, squares += x * x, fourths += x * x * x * x;
    }
    EXPECT_NEAR(sum / count, 0, 0.01);
    EXPECT_NEAR(squares / count, 1, 0.01);
    EXPECT_NEAR(fourths / count, 3, 0.1);
}

}  // namespace
}  // namespace rgbd_graphslam::synth
