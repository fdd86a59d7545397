#include "rgbd_graphslam/evaluation/point_cloud.h"

#include <gtest/gtest.h>

#include "../../support/made_trajectories.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

CameraModel smallCamera() {
    Intrinsics camera;
    camera.width = 4;
    camera.height = 3;
    camera.fx = camera.fy = 2;
    camera.cx = 1;
    camera.cy = 1;
    return camera;
}

RgbdImage emptyImage() {
    RgbdImage image;
    image.color = cv::Mat(3, 4, CV_8UC3, cv::Scalar(0, 0, 0));
    image.depth = cv::Mat(3, 4, CV_16UC1, cv::Scalar(0));
    image.depth_unit_m = 0.001;
    return image;
}

TEST(PointCloud, aPixelBecomesAPointInTheWorld) {
    RgbdImage image = emptyImage();
    image.depth.at<std::uint16_t>(2, 3) = 2000;
    image.color.at<cv::Vec3b>(2, 3) = {30, 20, 10};
    PointCloudBuilder builder(smallCamera(), {});
    builder.add(image, SE3(Eigen::Matrix3d::Identity(), {10, 20, 30}));
    ASSERT_EQ(builder.cloud().vertices.size(), 1u);
    EXPECT_TRUE(builder.cloud().vertices[0].isApprox(Eigen::Vector3f(12, 21, 32)));
    EXPECT_EQ(builder.cloud().colors[0], (std::array<std::uint8_t, 3>{10, 20, 30}));
}

TEST(PointCloud, distortedPixelsLieOnTheirTrueRays) {
    Intrinsics camera = smallCamera().intrinsics();
    camera.fx = camera.fy = 20;
    camera.lens = BrownLens{{0.2, -0.1, 0, 0, 0}};
    RgbdImage image = emptyImage();
    image.depth.at<std::uint16_t>(0, 3) = 1000;
    PointCloudBuilder builder(camera, {});
    builder.add(image, {});
    const Eigen::Vector3d p = builder.cloud().vertices.at(0).cast<double>();
    EXPECT_TRUE(CameraModel(camera).project(p).isApprox(Eigen::Vector2d(3, 0), 1e-4));
}

TEST(PointCloud, optionsLeaveOutPoints) {
    RgbdImage image = emptyImage();
    image.depth.setTo(1000);
    image.depth.at<std::uint16_t>(0, 0) = 5000;
    const auto points = [&](const PointCloudOptions& options) {
        PointCloudBuilder builder(smallCamera(), options);
        builder.add(image, {});
        return builder.cloud().vertices.size();
    };
    EXPECT_EQ(points({}), 12u);
    EXPECT_EQ(points({2, 0, 0}), 4u);
    EXPECT_EQ(points({1, 4, 0}), 11u);
    EXPECT_EQ(points({1, 0, 100}), 4u);  // the signs of x and y; all of z is positive
    EXPECT_THROW(points({0, 0, 0}), Error);
    EXPECT_THROW(points({1, -1, 0}), Error);
}

TEST(PointCloud, refusesAnImageOfAnotherSize) {
    PointCloudBuilder builder(CameraModel{}, {});
    EXPECT_THROW(builder.add(emptyImage(), {}), Error);
}

TEST(PosedImages, findTheirPosesByTheStampOfTheColor) {
    const TestFolder folder;
    folder.write("rgb.txt", "100.0 rgb/0.png\n105.01 rgb/1.png\n500 rgb/2.png\n");
    folder.write("depth.txt", "100.01 d/0.png\n105.0 d/1.png\n500 d/2.png\n");
    const auto images = posedImages(folder / "rgb.txt", folder / "depth.txt", circle(), 0.02);
    ASSERT_EQ(images.size(), 2u);
    EXPECT_EQ(images[1].color, folder / "rgb/1.png");
    EXPECT_EQ(images[1].depth, folder / "d/1.png");
    EXPECT_TRUE(images[1].T_world_cam.t.isApprox(circle()[50].T_world_cam.t));
}

TEST(PosedImages, ofPairsThatAreMadeAlready) {
    const TestFolder folder;
    folder.write("pairs.txt", "105.0 rgb/1.png 105.0 d/1.png\n");
    const auto images = posedImages(folder / "pairs.txt", circle(), 0.02);
    ASSERT_EQ(images.size(), 1u);
    EXPECT_EQ(images[0].color, folder / "rgb/1.png");
    EXPECT_EQ(images[0].depth, folder / "d/1.png");
}

TEST(PosedImages, errors) {
    const TestFolder folder;
    folder.write("far.txt", "9 rgb/0.png 9 d/0.png\n");
    EXPECT_THROW(posedImages(folder / "far.txt", circle(), 0.02), Error);
    folder.write("no_depth.txt", "100 rgb/0.png\n");
    EXPECT_THROW(posedImages(folder / "no_depth.txt", circle(), 0.02), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
