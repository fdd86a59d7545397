#include "rgbd_graphslam/mapping/upright.h"

#include <gtest/gtest.h>

#include "box_room.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;

/** A world that is neither level nor placed in any handy way. */
const SE3 T_odd_up(rotationExp({0.7, -0.4, 1.1}), {3, -2, 5});

Trajectory oddWalk(int views) {
    Trajectory trajectory;
    for (const SE3& T : walk(views)) trajectory.push_back({0.1 * trajectory.size(), T_odd_up * T});
    return trajectory;
}

std::vector<SurfacePatch> patchesOf(const Trajectory& trajectory) {
    const RayTable rays(smallCamera());
    Noise noise;
    std::vector<SurfacePatch> patches;
    for (const auto& [stamp, T] : trajectory) {
        const RgbdImage image =
            render(BoxRoom(), smallCamera(), T_odd_up.inverse() * T, stamp, &noise);
        const MapOptions options;
        const cv::Mat1f depth = cleanDepth(image, smallCamera(), options);
        for (const SurfacePatch& patch : surfacePatches(depth, rays, options.max_range_m)) {
            patches.push_back({T * patch.position, T.R * patch.normal});
        }
    }
    return patches;
}

/** What the accelerometer reads while the camera stands, with a shake. */
std::vector<SpecificForce> readingsOf(const Trajectory& trajectory) {
    Noise noise;
    std::vector<SpecificForce> readings;
    for (const auto& [stamp, T] : trajectory) {
        const Eigen::Vector3d shake(noise(), noise(), noise());
        readings.push_back({stamp + 0.03, T.R.transpose() * (9.81 * T_odd_up.R.col(2)) + shake});
    }
    return readings;
}

double degreesBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / M_PI;
}

TEST(Upright, accelerometerOfAStandingCameraPointsUp) {
    Trajectory still(200, {0, T_odd_up * walk(1)[0]});
    for (std::size_t i = 0; i < still.size(); ++i) still[i].stamp_s = 0.1 * static_cast<double>(i);
    const auto up = upFromAccelerometer(readingsOf(still), still);
    ASSERT_TRUE(up);
    EXPECT_LT(degreesBetween(*up, T_odd_up.R.col(2)), 1.5);
}

TEST(Upright, readingsThatDisagreeOrAreNotGravityAreRefused) {
    const Trajectory trajectory = oddWalk(40);
    auto readings = readingsOf(trajectory);
    EXPECT_FALSE(upFromAccelerometer({}, trajectory));
    for (std::size_t i = 0; i < readings.size(); i += 2) readings[i].in_camera *= -1;
    EXPECT_FALSE(upFromAccelerometer(readings, trajectory));
    readings = readingsOf(trajectory);
    for (auto& reading : readings) reading.in_camera /= 9.81;  // in units of g by mistake
    EXPECT_FALSE(upFromAccelerometer(readings, trajectory));
}

TEST(Upright, floorGivesUpAndItsHeight) {
    const Trajectory trajectory = oddWalk(12);
    const auto patches = patchesOf(trajectory);
    Eigen::Vector3d guess = Eigen::Vector3d::Zero();
    for (const auto& pose : trajectory) guess -= pose.T_world_cam.R.col(1);
    const auto up = upFromFloor(patches, guess.normalized(), M_PI / 4);
    ASSERT_TRUE(up);
    EXPECT_LT(degreesBetween(*up, T_odd_up.R.col(2)), 0.3);
    const auto heights = levelHeights(patches, *up);
    ASSERT_FALSE(heights.empty());
    const SE3 T_up_world = uprightFrame(*up, heights.front(), trajectory.front().T_world_cam);
    // A corner of the floor, and the first camera's place and heading.
    EXPECT_NEAR((T_up_world * (T_odd_up * Eigen::Vector3d(1, 1, 0))).z(), 0, 0.015);
    const SE3 T_up_first = T_up_world * trajectory.front().T_world_cam;
    EXPECT_LT(T_up_first.t.head<2>().norm(), 1e-9);
    EXPECT_NEAR(T_up_first.R(1, 2), 0, 1e-9);
    EXPECT_GT(T_up_first.R(0, 2), 0);
}

/** Few patches a little above most: between them, more seems to lie than at either height. */
TEST(Upright, floorIsFoundBelowAFewStrayPatches) {
    std::vector<SurfacePatch> patches(20, {Eigen::Vector3d(1, 1, 0.01), Eigen::Vector3d::UnitZ()});
    patches.insert(patches.end(), 2, {Eigen::Vector3d(1, 1, 0.05), Eigen::Vector3d::UnitZ()});
    const auto heights = levelHeights(patches, Eigen::Vector3d::UnitZ());
    ASSERT_FALSE(heights.empty());
    EXPECT_NEAR(heights.front(), 0.01, 1e-9);
}

TEST(Upright, nothingLevelInSightIsSaid) {
    EXPECT_FALSE(upFromFloor({}, Eigen::Vector3d::UnitZ(), M_PI / 4));
    const std::vector<SurfacePatch> wall{{Eigen::Vector3d(1, 1, 1), Eigen::Vector3d::UnitX()}};
    EXPECT_TRUE(levelHeights(wall, Eigen::Vector3d::UnitZ()).empty());
}

}  // namespace
}  // namespace rgbd_graphslam
