#include "rgbd_graphslam/slam/map_adjustment.h"

#include <gtest/gtest.h>

#include "exact_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {
namespace {

const SE3 a_little_off(rotationExp({0.01, -0.01, 0.005}), {0.02, -0.01, 0.01});

/** Keyframe 1 is a little off. */
class MapAdjustmentTest : public testing::Test {
  protected:
    MapAdjustmentTest() {
        exact_.add(0);
        exact_.add(1, a_little_off * ExactMap::truth(1));
    }
    MapAdjustment adjustment() const {
        return {exact_.map, exact_.cameras, options_.sensor,
                {1},        {0},           landmarksSeenBy({0, 1}, exact_.map)};
    }
    double poseError(int keyframe) const {
        return exact_.map.T_cam_world(keyframe).minus(ExactMap::truth(keyframe)).norm();
    }
    double pointError(int landmark) const {
        return (exact_.map.landmark(landmark).position - exact_.points()[landmark]).norm();
    }

    const SlamOptions options_;
    ExactMap exact_;
};

TEST_F(MapAdjustmentTest, bringsPosesAndPointsToWhereTheyFit) {
    MapAdjustment adjusted = adjustment();
    adjustBundle(adjusted.problem, 20);
    EXPECT_GT(poseError(1), 0.02);  // nothing has changed yet
    adjusted.apply(exact_.map);
    EXPECT_LT(poseError(1), 1e-3);
    EXPECT_EQ(poseError(0), 0);
    for (const int landmark : exact_.allLandmarks()) EXPECT_LT(pointError(landmark), 5e-3);
}

TEST_F(MapAdjustmentTest, outliersLoseTheirObservation) {
    const int moved = 7;
    exact_.map.setPosition(moved, exact_.points()[moved] + Eigen::Vector3d(0.5, 0, 0));
    exact_.map.setPose(1, ExactMap::truth(1));
    MapAdjustment adjusted = adjustment();
    markBundleOutliers(adjusted.problem);
    adjusted.apply(exact_.map);
    EXPECT_FALSE(exact_.map.landmark(moved).alive);
    EXPECT_TRUE(exact_.map.landmark(moved + 1).alive);
}

TEST_F(MapAdjustmentTest, landmarksThatDiedMeanwhileStayDead) {
    MapAdjustment adjusted = adjustment();
    exact_.map.removeLandmark(3);
    adjustBundle(adjusted.problem, 20);
    adjusted.apply(exact_.map);
    EXPECT_FALSE(exact_.map.landmark(3).alive);
    EXPECT_EQ(exact_.map.aliveLandmarks(), exact_.points().size() - 1);
}

TEST_F(MapAdjustmentTest, youngerKeyframesMoveWithTheNewestThatTookPart) {
    MapAdjustment adjusted = adjustment();
    exact_.add(
        2, ExactMap::truth(2) * ExactMap::truth(1).inverse() * a_little_off * ExactMap::truth(1));
    ASSERT_GT(poseError(2), 0.02);
    adjustBundle(adjusted.problem, 20);
    adjusted.carryYounger(exact_.map);
    adjusted.apply(exact_.map);
    EXPECT_LT(poseError(2), 2e-3);
}

TEST_F(MapAdjustmentTest, landmarksOfOneKeyframeAloneTakeNoPart) {
    const int alone = exact_.map.addKeyframe(exact_.view(ExactMap::truth(2)), ExactMap::truth(2));
    exact_.map.addLandmark({0, 0, 3}, alone, 0);
    EXPECT_EQ(landmarksSeenBy({0, 1}, exact_.map), exact_.allLandmarks());
    EXPECT_TRUE(landmarksSeenBy({alone}, exact_.map).empty());
}

TEST_F(MapAdjustmentTest, anotherThreadSolvesTheSame) {
    MapAdjustment here = adjustment();
    adjustBundle(here.problem, 20);
    BackgroundBundleAdjustment there(adjustment(),
                                     [](BundleProblem& problem) { adjustBundle(problem, 20); });
    EXPECT_GE(there.wait(), 0);
    const SE3& found = there.adjustment().problem.states.keyframes[0].T_body_world;
    EXPECT_EQ(found.R, here.problem.states.keyframes[0].T_body_world.R);
    EXPECT_EQ(found.t, here.problem.states.keyframes[0].T_body_world.t);
}

}  // namespace
}  // namespace rgbd_graphslam
