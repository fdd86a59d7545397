/** Several cameras as one. */
#include <gtest/gtest.h>

#include <array>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/slam/rig_cameras.h"
#include "rgbd_graphslam/slam/visual_slam.h"
#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

/** To the right, with a shorter focal length; looks over the shoulder of the first. */
const SE3 T_cam0_cam1(rotationExp({0.05, 2.2, 0}), {0.15, -0.02, -0.1});

Rig twoCameras() {
    Intrinsics wide;
    wide.width = 600;
    wide.fx = wide.fy = 480;
    wide.cx = 299.5;
    return {{{"FRONT", CameraModel(), SE3()}, {"REAR", wide, T_cam0_cam1}}};
}

/** \param seen whether each camera's lens is free */
Frame viewOf(SyntheticWorld& world, const Rig& rig, const SE3& T_world_body, double stamp_s,
             std::array<bool, 2> seen = {true, true}) {
    Frame frame;
    frame.stamp_s = stamp_s;
    for (int camera = 0; camera < 2; ++camera) {
        const RigCamera& c = rig.cameras[camera];
        Frame view = world.view(T_world_body * c.T_body_cam, stamp_s, c.model.rectified());
        if (seen[camera]) append(std::move(view), camera, frame);
    }
    frame.grid = RigCameras(rig).gridOf(frame.keypoints);
    return frame;
}

TEST(RigCameras, keypointsAreWhereTheirCameraSeesThem) {
    const RigCameras cameras(twoCameras());
    for (int number = 0; number < cameras.count(); ++number) {
        Keypoint k{200, 150, 2.5, 0, 0};
        k.camera = number;
        int views = 0;
        cameras.visitViews(cameras.pointOf(k),
                           [&](int camera, const Eigen::Vector2d& pixel, double depth_m) {
                               EXPECT_EQ(camera, number);
                               EXPECT_LT((pixel - Eigen::Vector2d(200, 150)).norm(), 1e-3);
                               EXPECT_NEAR(depth_m, 2.5, 1e-6);
                               ++views;
                               return false;
                           });
        EXPECT_EQ(views, 1) << "the cameras look different ways";
    }
}

TEST(RigCameras, theFirstCameraIsTheBodyWhereverItSitsOnTheRobot) {
    Rig rig = twoCameras();
    const SE3 T_robot_cam(rotationExp({0.3, -0.2, 0.1}), {0.5, 0.1, 0.8});
    for (RigCamera& camera : rig.cameras) camera.T_body_cam = T_robot_cam * camera.T_body_cam;
    const RigCameras cameras(rig);
    EXPECT_LT(cameras[1].T_cam_body().minus(T_cam0_cam1.inverse()).norm(), 1e-12);
    EXPECT_TRUE(cameras[0].T_cam_body().R.isIdentity(0));
}

struct RigRun {
    double rmse_m = 0;
    int lost = 0;
};

/** On a circle, one camera covered from frame 40 to 69. */
RigRun runWith(const Rig& rig, int covered) {
    SyntheticWorld world(24000);
    SlamOptions options;
    VisualSlam slam(options, rig);
    const SE3 T_truth_first = onCircle(0);
    double squares = 0;
    RigRun run;
    constexpr int frames = 120;
    for (int i = 0; i < frames; ++i) {
        std::array<bool, 2> seen = {true, rig.cameras.size() > 1};
        if (i >= 40 && i < 70) seen[covered] = false;
        const TrackedFrame tracked =
            slam.track(viewOf(world, twoCameras(), onCircle(0.02 * i), i / 30.0 + 1, seen));
        run.lost += tracked.origin == FrameOrigin::Lost;
        if (tracked.keyframe) slam.findLoops(*tracked.keyframe);
    }
    slam.finish();
    for (int i = 0; i < frames; ++i) {
        const SE3 truth = T_truth_first.inverse() * onCircle(0.02 * i);
        squares += (slam.frames()[i].T_world_cam.t - truth.t).squaredNorm();
    }
    run.rmse_m = std::sqrt(squares / frames);
    return run;
}

TEST(VisualSlamOfARig, goesOnWhileOneCameraIsCovered) {
    Rig one = twoCameras();
    one.cameras.pop_back();
    const RigRun alone = runWith(one, 1);  // never covered
    for (const int covered : {0, 1}) {
        const RigRun both = runWith(twoCameras(), covered);
        EXPECT_EQ(both.lost, 0) << covered;
        EXPECT_LT(both.rmse_m, std::max(alone.rmse_m, 0.002)) << covered;
    }
    EXPECT_GT(runWith(one, 0).lost, 0) << "a single camera is lost meanwhile";
}

TEST(VisualSlamOfARig, keepsItsMap) {
    SyntheticWorld world(24000);
    const Rig rig = twoCameras();
    VisualSlam slam(SlamOptions{}, rig);
    for (int i = 0; i < 40; ++i) slam.track(viewOf(world, rig, onCircle(0.02 * i), i + 1));
    slam.finish();
    ByteWriter out;
    encode(slam.snapshot(), out);
    ByteReader in(out.bytes());
    MapSnapshot map = decodeSnapshot(in);
    ASSERT_EQ(map.rig.cameras.size(), 2u);
    EXPECT_EQ(map.rig.cameras[1].label, "REAR");
    VisualSlam again(SlamOptions{}, rig, map, MapUse::Extend);
    const TrackedFrame found = again.track(viewOf(world, rig, onCircle(0.4), 100));
    EXPECT_EQ(found.origin, FrameOrigin::Recovered);
    EXPECT_LT((found.T_world_cam.t - (onCircle(0).inverse() * onCircle(0.4)).t).norm(), 0.01);
    EXPECT_THROW(VisualSlam(SlamOptions{}, CameraModel(), map, MapUse::Localize), Error)
        << "one camera instead of two";
    Rig bent = rig;
    bent.cameras[1].T_body_cam.t.x() += 0.01;
    EXPECT_THROW(VisualSlam(SlamOptions{}, bent, map, MapUse::Extend), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
