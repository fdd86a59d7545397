#include "rgbd_graphslam/slam/slam_map.h"

#include <gtest/gtest.h>

#include <random>

namespace rgbd_graphslam {
namespace {

Frame frameOf(int keypoints) {
    Frame frame;
    frame.keypoints.resize(keypoints);
    frame.descriptors.resize(keypoints);
    return frame;
}

/** Both directions of every observation must agree. */
void expectConsistent(const SlamMap& map) {
    std::size_t alive = 0;
    for (std::size_t id = 0; id < map.landmarks().size(); ++id) {
        const Landmark& landmark = map.landmark(static_cast<int>(id));
        alive += landmark.alive;
        EXPECT_EQ(landmark.alive, !landmark.observations.empty());
        for (std::size_t o = 0; o < landmark.observations.size(); ++o) {
            const Observation& seen = landmark.observations[o];
            EXPECT_EQ(map.keyframe(seen.keyframe).landmarks[seen.keypoint], static_cast<int>(id));
            if (o > 0) {
                EXPECT_LT(landmark.observations[o - 1].keyframe, seen.keyframe);
            }
        }
    }
    EXPECT_EQ(map.aliveLandmarks(), alive);
    for (const Keyframe& keyframe : map.keyframes()) {
        for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
            if (keyframe.landmarks[i] == no_landmark) continue;
            EXPECT_EQ(map.keypointOf(keyframe.landmarks[i], keyframe.id), static_cast<int>(i));
        }
    }
}

TEST(SlamMap, aKeyframeSeesNoLandmarkThatDiedSinceItWasTracked) {
    SlamMap map(1.2, 8);
    map.addKeyframe(frameOf(2), SE3());
    const int lives = map.addLandmark({0, 0, 1}, 0, 0);
    const int dies = map.addLandmark({0, 0, 2}, 0, 1);
    const std::vector<int> tracked = {dies, no_landmark, lives};
    map.removeLandmark(dies);
    map.addKeyframe(frameOf(3), SE3());
    map.addObservations(tracked, 1);
    EXPECT_EQ(map.keyframe(1).landmarks, (std::vector<int>{no_landmark, no_landmark, lives}));
    expectConsistent(map);
}

TEST(SlamMap, staysConsistentUnderRandomChanges) {
    std::mt19937 random(17);
    SlamMap map(1.2, 8);
    for (int k = 0; k < 12; ++k) map.addKeyframe(frameOf(60), SE3());
    for (int step = 0; step < 4000; ++step) {
        const int keyframe = static_cast<int>(random() % 12),
                  keypoint = static_cast<int>(random() % 60);
        if (map.keyframe(keyframe).culled) continue;
        const int there = map.keyframe(keyframe).landmarks[keypoint];
        const int landmark =
            map.landmarks().empty() ? 0 : static_cast<int>(random() % map.landmarks().size());
        switch (random() % 5) {
            case 0:
                if (there == no_landmark) map.addLandmark({0, 0, 1}, keyframe, keypoint);
                break;
            case 1:
                if (there == no_landmark && !map.landmarks().empty() &&
                    map.landmark(landmark).alive && map.keypointOf(landmark, keyframe) < 0) {
                    map.addObservation(landmark, keyframe, keypoint);
                }
                break;
            case 2:
                if (there != no_landmark) map.removeObservation(there, keyframe);
                break;
            case 3:
                if (there != no_landmark && landmark != there && map.landmark(landmark).alive) {
                    map.fuse(there, landmark);
                }
                break;
            default:
                if (random() % 400 == 0 && keyframe > 0) map.cull(keyframe, 0);
        }
    }
    EXPECT_GT(map.aliveLandmarks(), 20u);
    expectConsistent(map);
}

TEST(SlamMap, usesTheIdOfALandmarkAgainTwoKeyframesAfterItsDeath) {
    SlamMap map(1.2, 8);
    map.addKeyframe(frameOf(10), SE3());
    const int dead = map.addLandmark({0, 0, 1}, 0, 0);
    map.removeLandmark(dead);
    map.addKeyframe(frameOf(10), SE3());
    EXPECT_NE(map.addLandmark({0, 0, 1}, 1, 1), dead);
    map.addKeyframe(frameOf(10), SE3());
    EXPECT_EQ(map.addLandmark({0, 0, 2}, 2, 2), dead);
    EXPECT_TRUE(map.landmark(dead).alive);
    EXPECT_EQ(map.landmark(dead).first_keyframe, 2);
    EXPECT_EQ(map.aliveLandmarks(), 2u);
}

TEST(SlamMap, alignedHoldsForTheKeypointOfOneLandmarkAlone) {
    SlamMap map(1.2, 8);
    Frame frame = frameOf(3);
    frame.patches.resize(3);
    frame.keypoints[1].aligned = true;  // with the first landmark, see below
    const int first = map.addKeyframe(frameOf(3), SE3());
    const int second = map.addKeyframe(frame, SE3());
    const auto aligned = [&](int keypoint) {
        return map.keyframe(second).frame.keypoints[keypoint].aligned;
    };
    const int old = map.addLandmark({0, 0, 1}, first, 0);
    EXPECT_FALSE(map.landmark(old).patch) << "its keyframe had none";
    map.addObservation(old, second, 1);
    const int made = map.addLandmark({0, 0, 1}, second, 2);
    EXPECT_TRUE(map.landmark(made).patch);
    EXPECT_TRUE(aligned(1));
    EXPECT_TRUE(aligned(2)) << "it is the place of the patch";
    map.removeObservation(old, second);
    EXPECT_FALSE(aligned(1));
    map.fuse(made, old);
    EXPECT_FALSE(aligned(2)) << "the other landmark has another patch";
}

TEST(SlamMap, keepsThePatchesOfTheLatestKeyframeOnly) {
    SlamMap map(1.2, 8);
    Frame frame = frameOf(3);
    frame.patches.resize(3);
    map.addKeyframe(frame, SE3());
    EXPECT_EQ(map.keyframe(0).frame.patches.size(), 3u);
    map.addKeyframe(frame, SE3());
    EXPECT_EQ(map.keyframe(0).frame.patches.capacity(), 0u);
}

TEST(SlamMap, culledKeyframeMovesWithItsParent) {
    SlamMap map(1.2, 8);
    map.addKeyframe(frameOf(1), SE3());
    const int parent = map.addKeyframe(frameOf(1), SE3(Eigen::Matrix3d::Identity(), {1, 0, 0}));
    const int culled = map.addKeyframe(frameOf(1), SE3(Eigen::Matrix3d::Identity(), {3, 0, 0}));
    map.cull(culled, parent);
    map.setPose(parent, SE3(Eigen::Matrix3d::Identity(), {1, 5, 0}));
    EXPECT_LT((map.T_cam_world(culled).t - Eigen::Vector3d(3, 5, 0)).norm(), 1e-12);
}

TEST(SlamMap, whatHungOnACulledKeyframeHangsOnItsParent) {
    SlamMap map(1.2, 8);
    for (int k = 0; k < 3; ++k) {
        map.addKeyframe(frameOf(1), SE3(rotationExp({0, 0, 0.3 * k}), {1.0 * k, 0, 0}));
    }
    map.cull(2, 1);
    map.cull(1, 0);
    EXPECT_EQ(map.keyframe(2).parent, 0);
    EXPECT_LT((map.T_cam_world(2).t - Eigen::Vector3d(2, 0, 0)).norm(), 1e-12);
    map.setPose(0, SE3(Eigen::Matrix3d::Identity(), {0, 5, 0}));
    const SE3 moved = SE3(rotationExp({0, 0, 0.6}), {2, 0, 0}) * map.T_cam_world(0);
    EXPECT_LT((map.T_cam_world(2).t - moved.t).norm(), 1e-12);
}

TEST(SlamMap, holdsTheKeyframesThatThereAre) {
    SlamMap map(1.2, 8);
    for (int k = 0; k < 2; ++k) map.addKeyframe(frameOf(1), SE3());
    EXPECT_TRUE(map.isFixed(0));
    EXPECT_FALSE(map.isFixed(1));
    map.freeze();
    map.addKeyframe(frameOf(1), SE3());
    EXPECT_TRUE(map.isFixed(1));
    EXPECT_FALSE(map.isFixed(2));
}

TEST(SlamMap, covisibilityCountsSharedLandmarksBestFirst) {
    SlamMap map(1.2, 8);
    for (int k = 0; k < 3; ++k) map.addKeyframe(frameOf(40), SE3());
    for (int i = 0; i < 30; ++i) {
        const int landmark = map.addLandmark({0, 0, 1}, 0, i);
        map.addObservation(landmark, 1, i);
        if (i < 20) map.addObservation(landmark, 2, i);
    }
    const auto neighbors = map.covisible(0);
    ASSERT_EQ(neighbors.size(), 2u);
    EXPECT_EQ(neighbors[0].keyframe, 1);
    EXPECT_EQ(neighbors[0].shared, 30);
    EXPECT_EQ(neighbors[1].shared, 20);
    EXPECT_EQ(map.covisible(0, 25).size(), 1u);
}

}  // namespace
}  // namespace rgbd_graphslam
