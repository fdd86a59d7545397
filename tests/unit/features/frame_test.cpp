#include "rgbd_graphslam/features/frame.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include <cmath>
#include <random>
#include <set>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/features/frame_builder.h"

namespace rgbd_graphslam {
namespace {

TEST(KeypointGrid, visitsEveryKeypointWithinTheRadiusOnce) {
    std::mt19937 random(3);
    std::vector<Keypoint> keypoints(500);
    for (Keypoint& k : keypoints) {
        // Undistortion may move keypoints a little outside of the image.
        k.u = static_cast<float>(random() % 660) - 10;
        k.v = static_cast<float>(random() % 500) - 10;
    }
    const KeypointGrid grid(keypoints, 640, 480);
    for (int trial = 0; trial < 100; ++trial) {
        const float u = random() % 640, v = random() % 480, radius = 1 + random() % 90;
        std::multiset<int> visited;
        grid.visit(u, v, radius, [&](int i) { visited.insert(i); });
        for (int i = 0; i < 500; ++i) {
            const bool near = std::hypot(keypoints[i].u - u, keypoints[i].v - v) <= radius;
            if (near) {
                EXPECT_EQ(visited.count(i), 1u);
            } else {
                EXPECT_LE(visited.count(i), 1u);
            }
        }
    }
}

TEST(ForegroundDepth, takesTheNearSideOfAnEdge) {
    cv::Mat depth(10, 10, CV_16UC1, cv::Scalar(2000));
    depth.colRange(5, 10).setTo(1000);
    EXPECT_FLOAT_EQ(foregroundDepth(depth, 0.001, 5, 5, {}), 1.0f);
    EXPECT_FLOAT_EQ(foregroundDepth(depth, 0.001, 4, 5, {}), 1.0f);
    EXPECT_FLOAT_EQ(foregroundDepth(depth, 0.001, 2, 5, {}), 2.0f);
}

TEST(ForegroundDepth, averagesOneSurface) {
    cv::Mat depth(3, 3, CV_16UC1, cv::Scalar(1000));
    depth.at<std::uint16_t>(0, 0) = 1009;
    EXPECT_FLOAT_EQ(foregroundDepth(depth, 0.001, 1, 1, {}), 1.001f);
}

TEST(ForegroundDepth, isNoneWithFewReadingsOrOutOfRange) {
    cv::Mat depth(5, 5, CV_16UC1, cv::Scalar(0));
    depth.at<std::uint16_t>(2, 2) = 1000;
    depth.at<std::uint16_t>(2, 3) = 1000;
    EXPECT_EQ(foregroundDepth(depth, 0.001, 2, 2, {}), 0);
    depth.setTo(50000);
    EXPECT_EQ(foregroundDepth(depth, 0.001, 2, 2, {}), 0);
    depth.setTo(1000);
    EXPECT_FLOAT_EQ(foregroundDepth(depth, 0.001, 0, 0, {}), 1.0f);
}

TEST(FrameBuilder, refusesImagesOfAnotherSizeOrType) {
    const FrameBuilder builder({}, CameraModel{});
    RgbdImage image;
    image.gray = cv::Mat::zeros(480, 640, CV_8UC1);
    image.depth = cv::Mat::zeros(240, 320, CV_16UC1);
    EXPECT_THROW(builder.build(image), Error);
    image.depth = cv::Mat::zeros(480, 640, CV_8UC1);
    EXPECT_THROW(builder.build(image), Error);
    image.depth = cv::Mat::zeros(480, 640, CV_16UC1);
    EXPECT_TRUE(builder.build(image).keypoints.empty());
}

/** Corners everywhere. */
RgbdImage noisyImage() {
    RgbdImage image;
    image.gray = cv::Mat(480, 640, CV_8UC1);
    cv::RNG generator(7);
    generator.fill(image.gray, cv::RNG::UNIFORM, 0, 256);
    image.depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(2000));
    return image;
}

TEST(FrameBuilder, nothingIsTakenFromWhatTheMaskLeavesOut) {
    RgbdImage image = noisyImage();
    image.mask = cv::Mat(480, 640, CV_8UC1, cv::Scalar(255));
    image.mask.colRange(0, 320) = 0;
    const FrameBuilder builder({}, Camera{});
    const Frame frame = builder.build(image);
    ASSERT_GT(frame.keypoints.size(), 200u);
    EXPECT_EQ(frame.descriptors.size(), frame.keypoints.size());
    EXPECT_EQ(frame.patches.size(), frame.keypoints.size());
    for (const Keypoint& keypoint : frame.keypoints) EXPECT_GE(keypoint.u, 323);
    image.mask = cv::Mat(48, 64, CV_8UC1, cv::Scalar(255));
    EXPECT_THROW(builder.build(image), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
