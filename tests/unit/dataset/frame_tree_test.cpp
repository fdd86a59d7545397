/** Poses from ROS's tree of frames. */
#include "../../../libs/dataset/src/frame_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

using ::testing::UnorderedElementsAre;

void add(FrameTree& tree, double stamp_s, const std::string& parent, const std::string& child,
         double x, double y = 0) {
    tree.add({{stamp_s, parent}, child, {Eigen::Matrix3d::Identity(), {x, y, 0}}});
}

TEST(FrameTree, fixedPosesGoUpAndDown) {
    FrameTree tree;
    add(tree, 0, "/base", "/color", 1);
    add(tree, 0, "base", "depth", 3);
    ASSERT_TRUE(tree.fixedPose("color", "depth"));
    EXPECT_EQ(tree.fixedPose("color", "depth")->t.x(), 2);
    EXPECT_EQ(tree.fixedPose("depth", "/color")->t.x(), -2);
    EXPECT_EQ(tree.fixedPose("color", "base")->t.x(), -1);
    EXPECT_FALSE(tree.fixedPose("color", "laser"));
}

TEST(FrameTree, whatMovesIsNotFixed) {
    FrameTree tree;
    add(tree, 0, "base", "camera", 1);
    EXPECT_TRUE(tree.pathOf("camera", "base").empty()) << "known once";
    add(tree, 1, "base", "camera", 1);
    EXPECT_TRUE(tree.pathOf("camera", "base").empty()) << "said again";
    EXPECT_TRUE(tree.fixedPose("base", "camera"));
    add(tree, 2, "base", "camera", 2);
    EXPECT_EQ(tree.pathOf("camera", "base").size(), 3u);
    EXPECT_FALSE(tree.fixedPose("base", "camera"));
}

/** map to odom is corrected now and then, odom to base often. */
TEST(FrameTree, pathsFollowTheFrameThatIsPlacedMostOften) {
    FrameTree tree;
    for (int i = 0; i <= 10; ++i) add(tree, i, "odom", "base", i);
    add(tree, 0, "map", "odom", 0, 0);
    add(tree, 10, "map", "odom", 0, 1);
    add(tree, 0, "base", "camera", 0.5);
    const Trajectory path = tree.pathOf("camera", "map");
    ASSERT_EQ(path.size(), 11u);
    EXPECT_EQ(path[5].stamp_s, 5);
    EXPECT_NEAR(path[5].T_world_cam.t.x(), 5.5, 1e-12);
    EXPECT_NEAR(path[5].T_world_cam.t.y(), 0.5, 1e-12);
}

/** A motion capture system and the robot's odometry both place the base. */
TEST(FrameTree, aFrameMayHaveTwoParents) {
    FrameTree tree;
    for (int i = 0; i < 3; ++i) {
        add(tree, i, "odom", "base", i);
        add(tree, i, "mocap", "base", 10 * i);
    }
    EXPECT_THAT(tree.framesAbove("base"), UnorderedElementsAre("odom", "mocap"));
    EXPECT_EQ(tree.pathOf("base", "odom").back().T_world_cam.t.x(), 2);
    EXPECT_EQ(tree.pathOf("base", "mocap").back().T_world_cam.t.x(), 20);
}

TEST(FrameTree, circlesEnd) {
    FrameTree tree;
    add(tree, 0, "a", "b", 1);
    add(tree, 0, "b", "a", 1);
    EXPECT_THAT(tree.framesAbove("a"), UnorderedElementsAre("b"));
    EXPECT_TRUE(tree.pathOf("a", "c").empty());
}

}  // namespace
}  // namespace rgbd_graphslam
