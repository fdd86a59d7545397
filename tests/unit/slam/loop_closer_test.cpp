#include "rgbd_graphslam/slam/loop_closer.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/slam/slam_options.h"
#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

constexpr int steps = 42;
constexpr double step_rad = 0.15;  // all the way round

/** Round a room, where the map drifts by a centimeter per keyframe, to the first view again. Every
 *  keyframe has landmarks of its own. */
class LoopCloserTest : public testing::Test {
  protected:
    explicit LoopCloserTest(double last_turn = steps * step_rad) {
        options_.mapper.local_adjustment = false;
        for (int k = 0; k <= steps; ++k) add(k < steps ? k * step_rad : last_turn, k * drift_);
    }
    void add(double turn, const Eigen::Vector3d& drift) {
        const SE3 T_world_cam = onCircle(turn);
        const SE3 drifted(T_world_cam.R, T_world_cam.t + drift);
        const int id = map_.addKeyframe(world_.view(T_world_cam, map_.keyframes().size(), camera_),
                                        drifted.inverse());
        for (std::size_t i = 0; i < map_.keyframe(id).frame.keypoints.size(); ++i) {
            const Keypoint& k = map_.keyframe(id).frame.keypoints[i];
            map_.addLandmark(drifted * camera_.unproject(k.u, k.v, k.depth_m), id,
                             static_cast<int>(i));
        }
        found_ = closer_.findLoops(id);
    }

    const Eigen::Vector3d drift_{0, 0.005, 0};
    SlamOptions options_;
    const Camera camera_;
    const RigCameras cameras_{camera_};
    SyntheticWorld world_;
    SlamMap map_{1.2, 8};
    LocalMapper mapper_{options_, cameras_, map_};
    LoopCloser closer_{options_, cameras_, map_};
    std::vector<PoseEdge> found_;
};

TEST_F(LoopCloserTest, measuresAPlaceSeenAgain) {
    ASSERT_EQ(found_.size(), 1u);
    EXPECT_EQ(found_[0].to, steps);
    EXPECT_LT(found_[0].from, 3);
    const SE3 truth = onCircle(found_[0].from * step_rad).inverse() * onCircle(steps * step_rad);
    EXPECT_LT(found_[0].T_from_to.minus(truth).norm(), 0.01);
    EXPECT_GE(found_[0].inliers, options_.loops.min_inliers);
    EXPECT_EQ(closer_.loops().back().to, steps);
}

TEST_F(LoopCloserTest, correctionFusesBothViews) {
    ASSERT_EQ(found_.size(), 1u);
    const std::size_t landmarks = map_.aliveLandmarks();
    std::vector<SE3> truth;
    for (int k = 0; k <= steps; ++k) truth.push_back(onCircle(k * step_rad));
    EXPECT_TRUE(closer_.correct(truth, mapper_));
    EXPECT_LT(map_.aliveLandmarks(), landmarks - 100);
    EXPECT_EQ(map_.T_cam_world(steps).inverse().minus(truth.back()).norm(), 0);
}

TEST_F(LoopCloserTest, aLoopThatTheCorrectionIgnoredIsForgotten) {
    std::vector<SE3> unmoved;
    for (int k = 0; k <= steps; ++k) unmoved.push_back(map_.T_cam_world(k).inverse());
    EXPECT_FALSE(closer_.correct(unmoved, mapper_));
    EXPECT_TRUE(closer_.loops().empty());
}

TEST_F(LoopCloserTest, namesPlacesThatLookLikeAFrame) {
    const Frame frame = world_.view(onCircle(10.1 * step_rad), 100, camera_);
    const std::vector<int> places = closer_.placesLike(frame, 3);
    ASSERT_FALSE(places.empty());
    EXPECT_NEAR(places[0], 10, 1);
}

class HalfWayRound : public LoopCloserTest {
  protected:
    HalfWayRound() : LoopCloserTest(steps * step_rad / 2) {}
};

TEST_F(HalfWayRound, closesWhereItIs) {
    ASSERT_EQ(found_.size(), 1u);
    EXPECT_NEAR(found_[0].from, steps / 2, 2);
}

}  // namespace
}  // namespace rgbd_graphslam
