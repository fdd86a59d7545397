#include "rgbd_graphslam/slam/map_snapshot.h"

#include <gtest/gtest.h>

#include <limits>

#include "rgbd_graphslam/slam/visual_slam.h"
#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

/** The map of a camera that went part of the way round. */
MapSnapshot mapOfACircle(int frames = 40) {
    SyntheticWorld world(24000);
    VisualSlam slam(SlamOptions{}, Camera{});
    for (int i = 0; i < frames; ++i) slam.track(world.view(onCircle(0.02 * i), i + 1, Camera{}));
    slam.finish();
    MapSnapshot snapshot = slam.snapshot();
    LandmarkPatch seen;  // such as the landmarks of images have
    seen.octave = 3;
    seen.patch.corner = {0.25F, -0.5F};
    for (int i = 0; i < 256; ++i) seen.patch.gray[i] = static_cast<std::uint8_t>(i);
    snapshot.landmarks[7].patch = std::make_shared<LandmarkPatch>(seen);
    snapshot.keyframes[0].frame.keypoints[4].aligned = true;
    return snapshot;
}

std::string encoded(const MapSnapshot& snapshot) {
    ByteWriter out;
    encode(snapshot, out);
    return out.bytes();
}

MapSnapshot decoded(const std::string& bytes) {
    ByteReader in(bytes);
    return decodeSnapshot(in);
}

TEST(MapSnapshot, comesBackAsItWas) {
    const MapSnapshot kept = mapOfACircle();
    const std::string bytes = encoded(kept);
    const MapSnapshot back = decoded(bytes);
    EXPECT_TRUE(encoded(back) == bytes);
    ASSERT_EQ(back.keyframes.size(), kept.keyframes.size());
    ASSERT_GT(back.keyframes.size(), 3u);
    for (std::size_t k = 0; k < kept.keyframes.size(); ++k) {
        EXPECT_EQ(back.keyframes[k].landmarks, kept.keyframes[k].landmarks);
        EXPECT_EQ(back.keyframes[k].T_cam_world.t, kept.keyframes[k].T_cam_world.t);
        EXPECT_EQ(back.keyframes[k].T_cam_world.R, kept.keyframes[k].T_cam_world.R);
        EXPECT_EQ(back.keyframes[k].frame.descriptors, kept.keyframes[k].frame.descriptors);
    }
    EXPECT_EQ(back.landmarks.size(), kept.landmarks.size());
    ASSERT_TRUE(back.landmarks[7].patch);
    EXPECT_EQ(back.landmarks[7].patch->octave, 3);
    EXPECT_EQ(back.landmarks[7].patch->patch.corner, cv::Point2f(0.25F, -0.5F));
    EXPECT_EQ(back.landmarks[7].patch->patch.gray, kept.landmarks[7].patch->patch.gray);
    EXPECT_FALSE(back.landmarks[8].patch);
    EXPECT_TRUE(back.keyframes[0].frame.keypoints[4].aligned);
}

TEST(MapSnapshot, leavesDeadLandmarksBehind) {
    SlamMap map(1.25, 6);
    Frame frame;
    frame.keypoints.resize(3);
    frame.descriptors.resize(3);
    for (int k = 0; k < 3; ++k)
        map.addKeyframe(frame, {Eigen::Matrix3d::Identity(), {k * 1.0, 0, 0}});
    map.addLandmark({0, 0, 1}, 0, 0);
    map.addLandmark({0, 0, 2}, 0, 1);
    map.removeLandmark(0);
    map.cull(2, 1);
    map.cull(1, 0);
    const MapSnapshot kept = decoded(encoded(takeSnapshot(map, rigOf(Camera{}), 1.25, {})));
    ASSERT_EQ(kept.landmarks.size(), 1u);
    EXPECT_EQ(kept.landmarks[0].position.z(), 2);
    EXPECT_EQ(kept.keyframes[0].landmarks, (std::vector<int>{no_landmark, 0, no_landmark}));
    EXPECT_EQ(kept.keyframes[2].parent, 0);
    EXPECT_DOUBLE_EQ(kept.keyframes[2].T_cam_parent.t.x(), 2);
}

TEST(MapSnapshot, everyCutIsNoticed) {
    const std::string bytes = encoded(mapOfACircle(6));
    for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 97) {
        EXPECT_THROW(decoded(bytes.substr(0, length)), DamagedBytes) << length;
    }
}

/** Whatever the bytes say, decoding ends: with a map that is consistent, or with an error. */
TEST(MapSnapshot, changedBytesNeverBreakIt) {
    const std::string bytes = encoded(mapOfACircle(6));
    std::mt19937 random(5);
    int refused = 0;
    constexpr int trials = 400;
    for (int i = 0; i < trials; ++i) {
        std::string changed = bytes;
        for (int j = 0; j < 8; ++j)
            changed[random() % changed.size()] = static_cast<char>(random());
        try {
            const MapSnapshot map = decoded(changed);
            for (std::size_t id = 0; id < map.landmarks.size(); ++id) {
                for (const Observation& o : map.landmarks[id].observations) {
                    ASSERT_EQ(map.keyframes.at(o.keyframe).landmarks.at(o.keypoint),
                              static_cast<int>(id));
                }
            }
        } catch (const DamagedBytes&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, trials / 20);
}

TEST(MapSnapshot, refusesWhatCannotBe) {
    const MapSnapshot good = mapOfACircle(6);
    const auto refused = [&](auto&& spoil) {
        MapSnapshot bad = good;
        spoil(bad);
        EXPECT_THROW(decoded(encoded(bad)), DamagedBytes);
    };
    refused([](MapSnapshot& m) { m.keyframes.clear(); });
    refused([](MapSnapshot& m) { m.landmarks[0].observations[0].keyframe = 99999; });
    refused([](MapSnapshot& m) { m.landmarks[0].observations[0].keypoint = 99999; });
    refused([](MapSnapshot& m) { m.landmarks[1].observations = m.landmarks[0].observations; });
    refused([](MapSnapshot& m) { m.landmarks[0].observations.clear(); });
    refused([](MapSnapshot& m) {
        m.landmarks[0].position.x() = std::numeric_limits<double>::quiet_NaN();
    });
    refused([](MapSnapshot& m) { m.keyframes[0].frame.keypoints[0].octave = 200; });
    refused([](MapSnapshot& m) { m.keyframes[0].frame.keypoints[0].u = 1e30f; });
    refused([](MapSnapshot& m) { m.keyframes[0].T_cam_world.R *= 2; });
    refused([](MapSnapshot& m) { m.rig.cameras[0].model.width = 0; });
    refused([](MapSnapshot& m) { m.levels = 0; });
    refused([](MapSnapshot& m) { m.loops.push_back({0, 0, {}, Matrix6d::Identity()}); });
    refused([](MapSnapshot& m) { m.loops.push_back({0, 1, {}, Matrix6d::Zero()}); });
}

}  // namespace
}  // namespace rgbd_graphslam
