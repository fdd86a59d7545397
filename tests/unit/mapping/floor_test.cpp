#include "rgbd_graphslam/mapping/floor.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
const Eigen::Vector3d eye(0, 0, 1.5);

/** Patches on a level square. */
void addLevel(SurfaceView& view, const Eigen::Vector2d& middle, double half_m, double height_m,
              double step_m = 0.05) {
    for (double x = -half_m; x <= half_m; x += step_m) {
        for (double y = -half_m; y <= half_m; y += step_m) {
            view.patches.push_back({{middle.x() + x, middle.y() + y, height_m}, up});
        }
    }
}

void addWall(SurfaceView& view, double x, double low_m, double high_m) {
    for (double y = -2; y <= 2; y += 0.05) {
        for (double z = low_m; z <= high_m; z += 0.05) {
            view.patches.push_back({{x, y, z}, -Eigen::Vector3d::UnitX()});
        }
    }
}

SurfaceView tableInARoom() {
    SurfaceView view;
    view.eye = eye;
    addLevel(view, {2, 0}, 0.5, 0.75);
    addWall(view, 3, 0, 2);
    return view;
}

TEST(Floor, isTheLowestLevelSurface) {
    SurfaceView view = tableInARoom();
    addLevel(view, {0, 0}, 1, 0);
    const auto floor = findFloor({view}, up);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->height_m, 0, 1e-9);
    EXPECT_LT(floor->share_below, 0.001);
}

/** What a polished floor shows of a ceiling, as large as the floor itself. */
TEST(Floor, isNotTheMirrorImageBehindIt) {
    SurfaceView view = tableInARoom();
    addLevel(view, {0, 0}, 1.5, 0);
    addLevel(view, {0, 0}, 2, -2.4);
    const auto floor = findFloor({view}, up);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->height_m, 0, 1e-9);
    EXPECT_GT(floor->share_below, most_below_floor);
}

/** Steps down beside a landing are seen over its edge, not through it. */
TEST(Floor, mayLieBelowALanding) {
    SurfaceView view;
    view.eye = eye;
    addLevel(view, {0, 0}, 1, 0);
    addLevel(view, {4, 0}, 1, -1.2);
    const auto floor = findFloor({view}, up);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->height_m, -1.2, 1e-9);
}

TEST(Floor, withoutDepthLeavesWallsBelowTheTable) {
    const auto floor = findFloor({tableInARoom()}, up);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->height_m, 0.75, 1e-9);
    EXPECT_GT(floor->share_below, most_below_floor);
}

TEST(Floor, isNothingWhereNothingIsLevel) {
    SurfaceView view;
    view.eye = eye;
    addWall(view, 3, 0, 2);
    EXPECT_FALSE(findFloor({view}, up));
    EXPECT_FALSE(findFloor({}, up));
}

}  // namespace
}  // namespace rgbd_graphslam
