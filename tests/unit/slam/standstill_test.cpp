#include <gtest/gtest.h>

#include "rgbd_graphslam/slam/visual_slam.h"
#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

const Camera camera;

/** What fills the lower right quarter goes to the side and comes nearer. */
void moveAQuarter(Frame& frame, int step) {
    for (Keypoint& k : frame.keypoints) {
        if (2 * k.u < static_cast<float>(camera.width)) continue;
        if (2 * k.v < static_cast<float>(camera.height)) continue;
        k.u = std::min(k.u + 0.4f * static_cast<float>(step), camera.width - 1.f);
        k.depth_m *= 1 - 0.002f * static_cast<float>(step);
    }
    frame.grid = KeypointGrid(frame.keypoints, camera.width, camera.height);
}

/** Largest distance from the truth over 40 frames. \param per_frame_m motion to the side */
double worstError(bool detect, bool with_mover, double per_frame_m) {
    SyntheticWorld world;
    SlamOptions options;
    options.tracker.detect_standstill = detect;
    VisualSlam slam(options, camera);
    double worst = 0;
    for (int i = 0; i < 40; ++i) {
        const SE3 off(Eigen::Matrix3d::Identity(), Eigen::Vector3d(per_frame_m * i, 0, 0));
        Frame frame = world.view(onCircle(0) * off, i / 30.0, camera);
        if (with_mover) moveAQuarter(frame, i);
        const TrackedFrame tracked = slam.track(std::move(frame));
        EXPECT_EQ(tracked.origin, FrameOrigin::Tracked) << i;
        worst = std::max(worst, (tracked.T_world_cam.t - off.t).norm());
    }
    return worst;
}

TEST(Standstill, aCameraThatStandsDoesNotTremble) {
    EXPECT_GT(worstError(false, false, 0), 1e-4);
    EXPECT_LT(worstError(true, false, 0), 1e-9);
}

TEST(Standstill, whatWalksThroughAQuarterOfTheViewMovesNothing) {
    EXPECT_LT(worstError(true, true, 0), 0.3 * worstError(false, true, 0));
}

TEST(Standstill, slowMotionIsFollowed) {
    for (const double per_frame_m : {0.0003, 0.001, 0.01}) {
        EXPECT_LT(worstError(true, false, per_frame_m), 0.003) << per_frame_m;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
