#include "rgbd_graphslam/viewer/keyframe_view.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

TEST(KeyframePoints, lieWhereTheCameraSawThem) {
    const CameraModel camera;
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
        Intrinsics camera;
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

}  // namespace
}  // namespace rgbd_graphslam
