#include "../../../libs/slam/src/mover_watch.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/pixel_blocks.h"

namespace rgbd_graphslam {
namespace {

const Camera camera;
const RigCameras cameras(camera);

/** A wall 3 m ahead with a keypoint every 20 px; a box of 20 x 20 blocks 2 m ahead from column
 *  `left` of the small image on, if that is not negative. */
Frame frameAt(double stamp_s, int left = -1) {
    DenseView view;
    view.camera = PixelBlocks(camera).camera();
    view.gray.assign(80 * 60, 100);
    view.depth_m.assign(80 * 60, 3);
    for (int v = 20; left >= 0 && v < 40; ++v)
        for (int u = left; u < left + 20; ++u) view.depth_m[v * 80 + u] = 2;
    Frame frame;
    frame.stamp_s = stamp_s;
    for (int v = 10; v < 480; v += 20) {
        for (int u = 10; u < 640; u += 20) {
            Keypoint keypoint;
            keypoint.u = static_cast<float>(u), keypoint.v = static_cast<float>(v);
            keypoint.depth_m = view.depth_m[v / 8 * 80 + u / 8];
            frame.keypoints.push_back(keypoint);
            frame.descriptors.push_back({});
        }
    }
    std::promise<DenseView> promise;
    promise.set_value(view);
    frame.view = promise.get_future().share();
    return frame;
}

struct Watched {
    Watched() : map(1.2, 4), watch(cameras) {
        map.addKeyframe(frameAt(0), SE3());
        for (int i = 0; i < 6; ++i) watch.note(frameAt(0.6 * i), SE3(), 0, map);
    }
    SlamMap map;
    MoverWatch watch;
};

TEST(MoverWatch, keypointsOnWhatCameIntoTheViewAreFound) {
    Watched world;
    const Frame frame = frameAt(4, 30);
    const auto moving = world.watch.moving(frame, SE3(), 0, world.map);
    ASSERT_EQ(moving.size(), frame.keypoints.size());
    for (std::size_t i = 0; i < moving.size(); ++i)
        EXPECT_EQ(moving[i] != 0, frame.keypoints[i].depth_m < 2.5) << i;
}

TEST(MoverWatch, nothingIsFoundWhereNothingMoves) {
    Watched world;
    EXPECT_TRUE(world.watch.moving(frameAt(4), SE3(), 0, world.map).empty());
}

TEST(MoverWatch, anotherSubmapTellsNothing) {
    Watched world;
    EXPECT_TRUE(world.watch.moving(frameAt(4, 30), SE3(), 1, world.map).empty());
}

TEST(MoverWatch, goesOnFromACheckpointAsBefore) {
    Watched world;
    for (int i = 0; i < 3; ++i) {
        ByteWriter out;
        world.watch.save(out);
        MoverWatch loaded(cameras);
        ByteReader in(out.bytes());
        loaded.load(in, 1);
        EXPECT_EQ(in.left(), 0u);
        ByteWriter again;
        loaded.save(again);
        EXPECT_EQ(again.bytes(), out.bytes());
        const Frame frame = frameAt(4 + 0.03 * i, 30);
        const auto moving = world.watch.moving(frame, SE3(), 0, world.map);
        EXPECT_EQ(moving.size(), frame.keypoints.size());
        EXPECT_EQ(loaded.moving(frame, SE3(), 0, world.map), moving) << i;
        ByteReader without_keyframes(out.bytes());
        EXPECT_THROW(MoverWatch(cameras).load(without_keyframes, 0), DamagedBytes);
    }
}

TEST(MoverWatch, keypointsAreRemovedWithAllThatBelongsToThem) {
    Frame frame = frameAt(0, 30);
    const std::size_t before = frame.keypoints.size();
    std::vector<int> landmarks(before);
    for (std::size_t i = 0; i < before; ++i) {
        landmarks[i] = static_cast<int>(i);
        frame.descriptors[i][0] = i;
    }
    std::vector<char> moving(before);
    for (std::size_t i = 0; i < before; i += 3) moving[i] = 1;
    removeKeypoints(moving, cameras, frame, landmarks);
    ASSERT_EQ(frame.keypoints.size(), before - (before + 2) / 3);
    ASSERT_EQ(landmarks.size(), frame.keypoints.size());
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
        EXPECT_NE(landmarks[i] % 3, 0);
        EXPECT_EQ(frame.descriptors[i][0], static_cast<std::uint64_t>(landmarks[i]));
    }
    int in_grid = 0;
    frame.grid.visit(320, 240, 1000, [&](int) { ++in_grid; });
    EXPECT_EQ(in_grid, static_cast<int>(landmarks.size()));
}

}  // namespace
}  // namespace rgbd_graphslam
