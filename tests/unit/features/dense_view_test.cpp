#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "rgbd_graphslam/features/dense_view_builder.h"

namespace rgbd_graphslam {
namespace {

RgbdImage plainImage(int width = 640, int height = 480) {
    RgbdImage image;
    image.gray = cv::Mat(height, width, CV_8UC1, cv::Scalar(100));
    image.depth = cv::Mat(height, width, CV_16UC1, cv::Scalar(2000));
    image.depth_unit_m = 0.001;
    return image;
}

TEST(DenseView, isTheMeanOfEachBlock) {
    RgbdImage image = plainImage();
    image.gray(cv::Rect(8, 16, 4, 8)) = 200;  // half of block (1, 2)
    const DenseView view = DenseViewBuilder(CameraModel{}).build(image);
    ASSERT_EQ(view.camera.width, 80);
    ASSERT_EQ(view.camera.height, 60);
    EXPECT_FLOAT_EQ(view.gray[0], 100);
    EXPECT_FLOAT_EQ(view.gray[2 * 80 + 1], 150);
    EXPECT_FLOAT_EQ(view.depth_m[0], 2);
    EXPECT_EQ(view.depthShare(), 1);
}

TEST(DenseView, depthIsThatOfTheNearerSurface) {
    RgbdImage image = plainImage();
    image.depth(cv::Rect(0, 0, 8, 4)) = 1500;  // upper half of the first block
    image.depth(cv::Rect(8, 0, 8, 5)) = 0;     // most of the second
    const DenseView view = DenseViewBuilder(CameraModel{}).build(image);
    EXPECT_FLOAT_EQ(view.depth_m[0], 1.5f);
    EXPECT_EQ(view.depth_m[1], 0);
}

/** A point seen at a pixel of the full image is seen at the matching place of the small one. */
TEST(DenseView, cameraSeesTheSameRays) {
    const CameraModel full;
    const CameraModel small = full.shrunk(8);
    const Eigen::Vector3d ray = full.unproject(323.5, 227.5, 1);  // center of block (40, 28)
    EXPECT_LT((small.project(ray) - Eigen::Vector2d(40, 28)).norm(), 1e-9);
}

TEST(DenseView, lensDistortionIsTakenOut) {
    Intrinsics camera;
    camera.lens = BrownLens{{0.26, -0.95, 0, 0, 1.16}};
    RgbdImage image = plainImage();
    const Eigen::Vector2d seen = CameraModel(camera).unrectify({20 * 8 + 3.5, 45 * 8 + 3.5});
    cv::Rect spot(static_cast<int>(seen.x()) - 12, static_cast<int>(seen.y()) - 12, 24, 24);
    image.gray(spot) = 250;
    EXPECT_GT((seen - Eigen::Vector2d(163.5, 363.5)).norm(), 3);
    EXPECT_FLOAT_EQ(DenseViewBuilder(camera).build(image).gray[45 * 80 + 20], 250);
}

TEST(DenseView, smallImagesAreTakenAsTheyAre) {
    Intrinsics camera;
    camera.width = 32;
    camera.height = 24;
    EXPECT_EQ(DenseViewBuilder(camera).build(plainImage(32, 24)).gray.size(), 32u * 24u);
}

TEST(DenseView, halvingKeepsTheNearestSurface) {
    RgbdImage image = plainImage();
    image.depth(cv::Rect(0, 0, 8, 8)) = 1000;
    const DenseView half = halved(DenseViewBuilder(CameraModel{}).build(image));
    EXPECT_EQ(half.camera.width, 40);
    EXPECT_FLOAT_EQ(half.depth_m[0], 1);
    EXPECT_FLOAT_EQ(half.depth_m[1], 2);
    EXPECT_FLOAT_EQ(half.gray[0], 100);
    EXPECT_NEAR(half.contrast(), 0, 1e-3);
}

}  // namespace
}  // namespace rgbd_graphslam
