#include "rgbd_graphslam/viewer/picking.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

const Eigen::Vector2i size_px(640, 480);

Trajectory threeInARow() {
    return {{0, SE3(Eigen::Matrix3d::Identity(), {0, 0, 0})},
            {1, SE3(Eigen::Matrix3d::Identity(), {0, 1, 0})},
            {2, SE3(Eigen::Matrix3d::Identity(), {0, 2, 0})}};
}

TEST(KeyframeAt, isTheNearestToThePixel) {
    OrbitCamera camera;
    camera.azimuth_rad = 0;
    const Eigen::Vector2d at = camera.project({0, 1, 0}, size_px).head<2>();
    EXPECT_EQ(keyframeAt(threeInARow(), 3, at + Eigen::Vector2d(3, -4), camera, size_px), 1U);
    EXPECT_FALSE(keyframeAt(threeInARow(), 3, at + Eigen::Vector2d(0, 40), camera, size_px));
    EXPECT_FALSE(keyframeAt(threeInARow(), 1, at, camera, size_px));  // not yet there in a replay
}

TEST(KeyframeAt, isNeverBehindTheEye) {
    OrbitCamera camera;
    camera.azimuth_rad = 0;
    camera.elevation_rad = 0;
    camera.target = {-10, 1, 0};
    camera.distance_m = 5;  // the eye is at x = -5, the keyframes behind it
    EXPECT_FALSE(keyframeAt(threeInARow(), 3, {320, 240}, camera, size_px, 1e6));
}

TEST(SurfaceAt, isTheNearestDrawnPixelsPlace) {
    const OrbitCamera camera;
    const Eigen::Vector2i pixel(200, 150);
    cv::Mat1f depths(5, 5, 1.f);
    EXPECT_FALSE(surfaceAt(depths, pixel, camera, size_px));
    depths(0, 0) = 0.4f;
    depths(2, 3) = 0.9f;  // one pixel to the right
    const auto found = surfaceAt(depths, pixel, camera, size_px);
    ASSERT_TRUE(found);
    EXPECT_LT((*found - camera.unproject({201.5, 150.5}, 0.9f, size_px)).norm(), 1e-9);
}

}  // namespace
}  // namespace rgbd_graphslam
