#include "rgbd_graphslam/dataset/mrpt_conversions.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

TEST(MrptConversions, opticalAxesAreRightDownForward) {
    const Eigen::Vector3d forward(1, 0, 0), left(0, 1, 0), up(0, 0, 1);
    EXPECT_EQ(T_optical_from_mrpt * forward, Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(T_optical_from_mrpt * left, Eigen::Vector3d(-1, 0, 0));
    EXPECT_EQ(T_optical_from_mrpt * up, Eigen::Vector3d(0, -1, 0));
}

TEST(MrptConversions, opticalFrameIsMrptsUsualIntensityCamera) {
    using mrpt::DEG2RAD;
    const mrpt::poses::CPose3D usual(0, 0, 0, DEG2RAD(-90.0), 0, DEG2RAD(-90.0));
    EXPECT_LT((toSE3(usual).R - T_optical_from_mrpt.inverse().R).norm(), 1e-15);
}

TEST(MrptConversions, posesSurvive) {
    const SE3 T(rotationExp({0.3, -1.2, 0.9}), {1, -2, 3});
    const SE3 back = toSE3(toCPose3D(T));
    EXPECT_EQ(back.R, T.R);
    EXPECT_EQ(back.t, T.t);
}

TEST(MrptConversions, stampsSurviveToTheMicrosecond) {
    for (const double stamp : {0.0, 1305031102.175304, 1305031453.374112, 1700100000.033333}) {
        EXPECT_EQ(toSeconds(toMrptTime(stamp)), stamp);
    }
}

TEST(MrptConversions, stampsAgreeWithMrptsClock) {
    EXPECT_NEAR(mrpt::Clock::toDouble(toMrptTime(1305031102.175304)), 1305031102.175304, 1e-6);
}

TEST(MrptConversions, lensSurvives) {
    Intrinsics camera;
    camera.width = 320;
    camera.height = 200;
    camera.fx = 517.3;
    camera.fy = 516.5;
    camera.cx = 318.6;
    camera.cy = 255.3;
    camera.lens = BrownLens{{0.2624, -0.9531, -0.0054, 0.0026, 1.1633}};
    const mrpt::img::TCamera mrpt_camera = toTCamera(camera);
    EXPECT_EQ(mrpt_camera.p1(), -0.0054);
    EXPECT_EQ(mrpt_camera.k3(), 1.1633);
    const Intrinsics back = toCamera(mrpt_camera);
    EXPECT_EQ(back.width, 320);
    EXPECT_EQ(back.height, 200);
    EXPECT_EQ(back.fy, 516.5);
    EXPECT_EQ(back.cx, 318.6);
    EXPECT_TRUE(back.lens == camera.lens);
}

TEST(MrptConversions, rationalAndFisheyeLensesSurvive) {
    for (const Lens& lens : {Lens(BrownLens{{0.5, -2.7, 0.001, -0.002, 1.6, 0.4, -2.5, 1.5}}),
                             Lens(KannalaBrandtLens{{0.1, 0.02, -0.003, 0.004}})}) {
        Intrinsics camera;
        camera.lens = lens;
        EXPECT_TRUE(toCamera(toTCamera(camera)) == camera);
    }
}

TEST(MrptConversions, coefficientsOfACameraWithoutLensModelAreIgnored) {
    mrpt::img::TCamera camera;
    camera.dist[0] = 0.5;
    EXPECT_FALSE(toCamera(camera).hasDistortion());
}

}  // namespace
}  // namespace rgbd_graphslam
