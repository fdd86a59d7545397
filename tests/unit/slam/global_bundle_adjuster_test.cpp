#include "rgbd_graphslam/slam/global_bundle_adjuster.h"

#include <gtest/gtest.h>

#include <random>

namespace rgbd_graphslam {
namespace {

constexpr int points = 120, views = 8;

/** A map of exact measurements whose poses and points are a little wrong. */
class FullAdjustment : public testing::Test {
  protected:
    FullAdjustment() {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> any(-1, 1);
        for (int p = 0; p < points; ++p) {
            truth_.emplace_back(any(random), any(random), 3 + any(random));
        }
        for (int k = 0; k < views; ++k) {
            const Vector6d off = 0.01 * Vector6d::NullaryExpr([&] { return any(random); });
            addView(k == 0 ? truthOf(0) : truthOf(k).retract(off));
        }
        for (int p = 0; p < points; ++p) {
            const Eigen::Vector3d off = 0.01 * Eigen::Vector3d(any(random), any(random), 1);
            map_.addLandmark(truth_[p] + off, 0, p);
            for (int k = 1; k < views; ++k) map_.addObservation(p, k, p);
        }
    }

    static SE3 truthOf(int k) { return {rotationExp({0, 0.05 * k, 0}), {0.1 * k, 0, 0}}; }

    /** A keyframe that sees every point; one keypoint more is free. */
    int addView(const SE3& T_cam_world) {
        Frame frame;
        const SE3 truth = truthOf(static_cast<int>(map_.keyframes().size()));
        for (const Eigen::Vector3d& point : truth_) {
            const Eigen::Vector3d p = truth * point;
            const Eigen::Vector2d pixel = camera_.project(p);
            frame.keypoints.push_back({static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
                                       static_cast<float>(p.z()), 0, 0});
        }
        frame.keypoints.push_back({1, 1, 1, 0, 0});
        frame.descriptors.resize(frame.keypoints.size());
        return map_.addKeyframe(std::move(frame), T_cam_world, 0, Link::Tracked);
    }

    double worstPose() const {
        double worst = 0;
        for (int k = 0; k < views; ++k) {
            worst = std::max(worst, map_.T_cam_world(k).minus(truthOf(k)).norm());
        }
        return worst;
    }

    const SlamOptions options_;
    const Camera camera_;
    const RigCameras cameras_{camera_};
    std::vector<Eigen::Vector3d> truth_;
    SlamMap map_{1.2, 8};
    GlobalBundleAdjuster adjuster_{options_, cameras_, map_};
};

TEST_F(FullAdjustment, bringsEveryPoseToItsPlace) {
    ASSERT_GT(worstPose(), 0.005);
    adjuster_.start(20);
    EXPECT_TRUE(adjuster_.pending());
    EXPECT_GT(adjuster_.applyPendingAdjustment(), 0);
    EXPECT_FALSE(adjuster_.pending());
    EXPECT_LT(worstPose(), 2e-5);
}

TEST_F(FullAdjustment, whatJoinedSinceMovesWithTheNewestKeyframe) {
    adjuster_.start(20);
    const int young =
        addView(map_.T_cam_world(views - 1) * SE3(rotationExp({0, 0.1, 0}), {0, 0, 0}));
    const int landmark = map_.addLandmark({0.1, 0.2, 2}, young, points);
    const auto relative = [&] {
        return map_.T_cam_world(young) * map_.T_cam_world(views - 1).inverse();
    };
    const SE3 pose_before = relative();
    const Eigen::Vector3d seen_before = map_.T_cam_world(young) * map_.landmark(landmark).position;
    const SE3 newest_before = map_.T_cam_world(views - 1);
    adjuster_.applyPendingAdjustment();
    EXPECT_GT(map_.T_cam_world(views - 1).minus(newest_before).norm(), 0.001);
    EXPECT_LT(relative().minus(pose_before).norm(), 1e-12);
    EXPECT_LT((map_.T_cam_world(young) * map_.landmark(landmark).position - seen_before).norm(),
              1e-12);
}

TEST_F(FullAdjustment, aLandmarkThatTookTheIdOfAnotherIsNotMistakenForIt) {
    adjuster_.start(20);
    map_.removeLandmark(7);
    for (int i = 0; i < 2; ++i) addView(map_.T_cam_world(views - 1));
    const int young = static_cast<int>(map_.keyframes().size()) - 1;
    ASSERT_EQ(map_.addLandmark({5, 5, 5}, young, points), 7);
    const Eigen::Vector3d seen_before = map_.T_cam_world(young) * map_.landmark(7).position;
    adjuster_.applyPendingAdjustment();
    EXPECT_LT((map_.T_cam_world(young) * map_.landmark(7).position - seen_before).norm(), 1e-12);
}

TEST_F(FullAdjustment, goesOnWhereItWasSaved) {
    adjuster_.start(20);
    ByteWriter out;
    adjuster_.save(out);
    SlamMap copy = map_;
    GlobalBundleAdjuster other(options_, cameras_, copy);
    ByteReader in(out.bytes());
    other.load(in);
    ASSERT_TRUE(other.pending());
    other.applyPendingAdjustment();
    adjuster_.applyPendingAdjustment();
    for (int k = 0; k < views; ++k) {
        EXPECT_EQ(copy.T_cam_world(k).R, map_.T_cam_world(k).R) << k;
        EXPECT_EQ(copy.T_cam_world(k).t, map_.T_cam_world(k).t) << k;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
