#include "rgbd_graphslam/geometry/trajectory.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

Trajectory walk() {
    Trajectory poses(3);
    for (int i = 0; i < 3; ++i) {
        poses[i].stamp_s = i < 2 ? i : 5;
        poses[i].T_world_cam = {rotationExp({0, 0, 0.1 * i}), {1.0 * i, 0, 0}};
    }
    return poses;
}

TEST(PoseAt, isBetweenItsNeighbors) {
    const auto pose = poseAt(walk(), 0.25);
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->t.x(), 0.25, 1e-12);
    EXPECT_NEAR(rotationLog(pose->R).z(), 0.025, 1e-12);
    EXPECT_EQ(poseAt(walk(), 0)->t.x(), 0);
    EXPECT_EQ(poseAt(walk(), 5)->t.x(), 2);
}

TEST(PoseAt, isNothingOutsideAndInGaps) {
    EXPECT_FALSE(poseAt(walk(), -0.1));
    EXPECT_FALSE(poseAt(walk(), 5.1));
    EXPECT_FALSE(poseAt(walk(), 3, 1));
    EXPECT_TRUE(poseAt(walk(), 3, 4));
    EXPECT_TRUE(poseAt(walk(), 5, 1));
    EXPECT_FALSE(poseAt({}, 1));
}

TEST(AnyBetween, countsNeitherEnd) {
    const std::vector<double> lost = {1, 2.5, 7};
    EXPECT_TRUE(anyBetween(lost, 2, 3));
    EXPECT_TRUE(anyBetween(lost, 0, 100));
    EXPECT_FALSE(anyBetween(lost, 1, 2.5));
    EXPECT_FALSE(anyBetween(lost, 3, 6));
    EXPECT_FALSE(anyBetween(lost, 7, 9));
    EXPECT_FALSE(anyBetween({}, 0, 9));
}

}  // namespace
}  // namespace rgbd_graphslam
