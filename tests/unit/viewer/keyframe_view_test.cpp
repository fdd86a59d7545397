#include "rgbd_graphslam/viewer/keyframe_view.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/viewer/recording_loader.h"

namespace rgbd_graphslam {
namespace {

TEST(KeyframePoints, lieWhereTheCameraSawThem) {
    const Camera camera;
    cv::Mat3b color(480, 640, cv::Vec3b(10, 20, 30));
    cv::Mat1w depth(480, 640, static_cast<std::uint16_t>(0));
    depth.colRange(0, 320) = 2000;
    const Vertices points = keyframePoints(color, depth, 0.001, camera);
    ASSERT_GT(points.size(), points_a_keyframe / 3);
    ASSERT_LE(points.size(), points_a_keyframe);
    for (const Vertex& p : points) {
        EXPECT_FLOAT_EQ(p.position.z(), 2);
        EXPECT_LE(p.position.x(), 0.01f);  // the left half
        EXPECT_EQ(p.color, (Rgba{30, 20, 10, 255}));
    }
}

TEST(KeyframePoints, areNeverTooMany) {
    for (const cv::Size size : {cv::Size(64, 48), cv::Size(333, 251), cv::Size(1920, 1080)}) {
        const cv::Mat3b color(size, cv::Vec3b());
        const cv::Mat1w depth(size, static_cast<std::uint16_t>(1000));
        Camera camera;
        camera.width = size.width, camera.height = size.height;
        EXPECT_LE(keyframePoints(color, depth, 0.001, camera).size(), points_a_keyframe);
    }
}

TEST(PaintedDepth, nearIsRedFarIsBlueNothingIsBlack) {
    const cv::Mat1w depth = (cv::Mat1w(1, 3) << 500, 5900, 0);
    const cv::Mat3b painted = paintedDepth(depth, 0.001);
    EXPECT_GT(painted(0, 0)[2], painted(0, 0)[0]);
    EXPECT_GT(painted(0, 1)[0], painted(0, 1)[2]);
    EXPECT_EQ(painted(0, 2), cv::Vec3b());
}

TEST(Thinned, keepsWhatIsSmallEnough) {
    EXPECT_EQ(thinned(cv::Mat3b(480, 640), 320).size(), cv::Size(320, 240));
    EXPECT_EQ(thinned(cv::Mat3b(240, 320), 320).size(), cv::Size(320, 240));
    EXPECT_EQ(thinned(cv::Mat3b(720, 1280), 320).size(), cv::Size(320, 180));
}

TEST(AlignedTruth, liesOverTheEstimate) {
    const SE3 T_truth_estimate(rotationExp({0.1, 0.2, 2}), {3, -1, 7});
    Trajectory estimate, truth;
    for (int i = 0; i < 20; ++i) {
        const SE3 pose(rotationExp({0, 0, 0.1 * i}), {std::sin(0.3 * i), 0.1 * i, 0.02 * i * i});
        estimate.push_back({1.0 * i, pose});
        truth.push_back({1.0 * i, T_truth_estimate * pose});
    }
    truth.push_back({500, SE3()});  // long after
    const TrueTrajectory aligned = alignedTruth(estimate, truth);
    EXPECT_EQ(aligned.poses.size(), 20U);
    EXPECT_LT(aligned.rmse_m, 1e-9);
    ASSERT_EQ(aligned.errors.size(), 20U);
    EXPECT_LT((aligned.poses[7].T_world_cam.t - estimate[7].T_world_cam.t).norm(), 1e-9);
    EXPECT_LT((aligned.errors[7].truth - aligned.errors[7].estimate).norm(), 1e-9);
}

}  // namespace
}  // namespace rgbd_graphslam
