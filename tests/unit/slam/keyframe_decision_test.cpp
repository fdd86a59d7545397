#include "../../../libs/slam/src/keyframe_decision.h"

#include <gtest/gtest.h>

#include "exact_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {
namespace {

constexpr int enough_frames = 10;

/** One keyframe at the origin, points about 3 m before it. */
class KeyframeDecisionTest : public testing::Test {
  protected:
    KeyframeDecisionTest() {
        exact_.add(0);
        decision_.reset(exact_.map.keyframe(0));
    }
    LocatedFrame at(const SE3& T_cam_world, int inliers = 100) const {
        LocatedFrame located{T_cam_world, {}, inliers};
        located.landmarks.assign(exact_.points().size(), no_landmark);
        return located;
    }
    bool wants(const LocatedFrame& located, int frames = enough_frames) {
        return decision_.wants(exact_.map, located, frames);
    }

    const KeyframeOptions options_;
    ExactMap exact_;
    KeyframeDecision decision_{options_};
};

const SE3 far_away(Eigen::Matrix3d::Identity(), {1, 0, 0});

TEST_F(KeyframeDecisionTest, standingStillMakesNone) {
    EXPECT_FALSE(wants(at(SE3())));
}

TEST_F(KeyframeDecisionTest, aLongWayMakesOne) {
    EXPECT_TRUE(wants(at(far_away)));
}

TEST_F(KeyframeDecisionTest, aTurnMakesOne) {
    EXPECT_TRUE(wants(at({rotationExp({0, 0.3, 0}), Eigen::Vector3d::Zero()})));
}

TEST_F(KeyframeDecisionTest, theIntervalIsKept) {
    EXPECT_FALSE(wants(at(far_away), options_.min_interval_frames - 1));
    EXPECT_TRUE(wants(at(far_away), options_.min_interval_frames));
}

TEST_F(KeyframeDecisionTest, landmarksThatGetLostMakeOne) {
    EXPECT_FALSE(wants(at(SE3(), 100)));
    EXPECT_FALSE(wants(at(SE3(), 60)));  // fewer, but the camera has not moved
    EXPECT_TRUE(wants(at(SE3(), 40)));   // less than half
    const SE3 a_little(Eigen::Matrix3d::Identity(), {0.1, 0, 0});
    EXPECT_TRUE(wants(at(a_little, 60)));
}

TEST_F(KeyframeDecisionTest, aKnownViewIsComparedWithInsteadOfMadeAgain) {
    exact_.add(1, far_away);
    exact_.add(2, far_away);  // landmarks are established by three keyframes
    LocatedFrame located = at(far_away);
    located.landmarks = exact_.allLandmarks();
    located.inliers = static_cast<int>(exact_.points().size());
    EXPECT_FALSE(wants(located));
    EXPECT_NE(decision_.reference(), 0);
}

}  // namespace
}  // namespace rgbd_graphslam
