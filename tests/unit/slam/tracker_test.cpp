#include "rgbd_graphslam/slam/tracker.h"

#include <gtest/gtest.h>

#include "exact_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {
namespace {

class TrackerTest : public testing::Test {
  protected:
    TrackerTest() {
        exact_.add(0);
        tracker_.setLast(exact_.view(ExactMap::truth(0)),
                         {ExactMap::truth(0), exact_.allLandmarks()}, 0, true);
    }
    std::optional<LocatedFrame> track(const SE3& T_cam_world) {
        Frame frame = exact_.view(T_cam_world, 1);
        return tracker_.track(frame);
    }

    const SlamOptions options_;
    ExactMap exact_;
    Tracker tracker_{options_, exact_.cameras, exact_.map};
};

TEST_F(TrackerTest, findsThePoseOfTheNextFrame) {
    const auto located = track(ExactMap::truth(1));
    ASSERT_TRUE(located);
    EXPECT_LT(located->T_cam_world.minus(ExactMap::truth(1)).norm(), 1e-4);
    EXPECT_EQ(located->inliers, static_cast<int>(exact_.points().size()));
    EXPECT_EQ(located->landmarks, exact_.allLandmarks());
    EXPECT_GT(located->information.determinant(), 0);
}

TEST_F(TrackerTest, findsNothingWhereTheMapIsNotSeen) {
    EXPECT_FALSE(track({rotationExp({0, 3.1, 0}), {0, 0, 6}}));
}

TEST_F(TrackerTest, asksForTheMinimumOfInliers) {
    SlamOptions options;
    options.tracker.min_inliers = static_cast<int>(exact_.points().size()) + 1;
    Tracker strict(options, exact_.cameras, exact_.map);
    strict.setLast(exact_.view(ExactMap::truth(0)), {ExactMap::truth(0), exact_.allLandmarks()}, 0,
                   true);
    Frame frame = exact_.view(ExactMap::truth(1), 1);
    EXPECT_FALSE(strict.track(frame));
}

TEST_F(TrackerTest, theLastFrameMovesWithItsKeyframe) {
    const SE3 T_new_old(Eigen::Matrix3d::Identity(), {10, 0, 0});
    exact_.map.setPose(0, ExactMap::truth(0) * T_new_old.inverse());
    for (const int landmark : exact_.allLandmarks()) exact_.map.moveLandmark(landmark, T_new_old);
    const auto located = track(ExactMap::truth(1));
    ASSERT_TRUE(located);
    const SE3 expected = ExactMap::truth(1) * T_new_old.inverse();
    EXPECT_LT(located->T_cam_world.minus(expected).norm(), 1e-4);
}

TEST_F(TrackerTest, followsTheLastFrameWithoutAMap) {
    const Frame frame = exact_.view(ExactMap::truth(1), 1);
    for (const int landmark : exact_.allLandmarks()) exact_.map.removeLandmark(landmark);
    const auto located = tracker_.followLast(frame, ExactMap::truth(0));
    ASSERT_TRUE(located);
    EXPECT_LT(located->T_cam_world.minus(ExactMap::truth(1)).norm(), 1e-3);
}

TEST_F(TrackerTest, knowsNothingAfterForgetting) {
    ASSERT_TRUE(tracker_.hasLast());
    tracker_.forget();
    EXPECT_FALSE(tracker_.hasLast());
    EXPECT_TRUE(tracker_.features().empty());
}

}  // namespace
}  // namespace rgbd_graphslam
