#include "rgbd_graphslam/mapping/level_scan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "box_room.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;

BoxRoom emptyRoom() {
    BoxRoom room;
    room.furniture.clear();
    return room;
}

/** Of a level ray of the scan, from the base's heading to the left, rad. */
double angleOf(const mrpt::obs::CObservation2DRangeScan& scan, std::size_t ray) {
    return scan.aperture *
           (static_cast<double>(ray) / static_cast<double>(scan.getScanSize() - 1) - 0.5);
}

mrpt::obs::CObservation2DRangeScan::Ptr scanOf(const BoxRoom& room, const SE3& T_room_cam,
                                               const MapOptions& options, Noise* noise) {
    const RayTable rays(smallCamera());
    const DepthView view(render(room, smallCamera(), T_room_cam, 0, noise), rays, options);
    return levelScan(view, basePose(T_room_cam).inverse() * T_room_cam, options);
}

TEST(LevelScan, noiseDoesNotBringWallsNearer) {
    Noise noise;
    const double yaw = 0.4;
    const SE3 T = lookingAlong({-1, -0.5, 1.2}, yaw, 0.1);
    const auto scan = scanOf(emptyRoom(), T, MapOptions(), &noise);
    double sum_m = 0;
    int valid = 0;
    for (std::size_t ray = 0; ray < scan->getScanSize(); ++ray) {
        if (!scan->getScanRangeValidity(ray)) continue;
        const double angle = yaw + angleOf(*scan, ray);
        const double expected =
            emptyRoom().cast({-1, -0.5, 1}, {std::cos(angle), std::sin(angle), 1e-9}).distance;
        const double error = scan->getScanRange(ray) - expected;
        EXPECT_LT(std::abs(error), 0.03) << ray;
        sum_m += error;
        ++valid;
    }
    ASSERT_GT(valid, 140);
    EXPECT_LT(std::abs(sum_m / valid), 0.004);  // the nearest readings are 6 cm too near
}

TEST(LevelScan, tellsTheNearestOfTwoSurfaces) {
    const SE3 T = lookingAlong({-1, 0, 1.2}, 0, 0.3);
    const auto scan = scanOf(BoxRoom(), T, MapOptions(), nullptr);
    const std::size_t ahead = scan->getScanSize() / 2;
    ASSERT_TRUE(scan->getScanRangeValidity(ahead));
    EXPECT_NEAR(scan->getScanRange(ahead), 2.2, 0.02);  // the table, 0.74 m high, not the wall
}

TEST(LevelScan, whatIsOutOfReachIsInvalid) {
    MapOptions options;
    options.max_range_m = 2;
    const auto scan = scanOf(emptyRoom(), lookingAlong({-1, 0, 1.2}, 0, 0), options, nullptr);
    for (std::size_t ray = 0; ray < scan->getScanSize(); ++ray)
        ASSERT_FALSE(scan->getScanRangeValidity(ray)) << ray;
}

}  // namespace
}  // namespace rgbd_graphslam
