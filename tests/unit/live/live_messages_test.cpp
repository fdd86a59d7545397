#include "rgbd_graphslam/live/live_messages.h"

#include <gtest/gtest.h>

#include <random>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

const SE3 pose(rotationExp({0.1, -0.2, 0.3}), {1, 2, 3});

RgbdImage smoothImage(int width, int height) {
    RgbdImage image;
    image.color = cv::Mat(height, width, CV_8UC3);
    image.depth = cv::Mat(height, width, CV_16UC1);
    image.depth_unit_m = 0.0002;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.color.at<cv::Vec3b>(y, x) = cv::Vec3b(static_cast<uchar>(x * 255 / width),
                                                        static_cast<uchar>(y * 255 / height), 90);
            image.depth.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(1000 + 10 * y + x);
        }
    }
    return image;
}

LiveFrame someFrame() {
    LiveFrame frame;
    frame.stamp_s = 1234.5;
    frame.T_world_cam = pose;
    frame.keyframe = 7;
    frame.features = {{1.5f, 2.5f, FeatureState::Lost}, {3, 4, FeatureState::Tracked}};
    frame.statistics = {{1.0, 5.5f, 300, false}, {2.0, 6.5f, 0, true}};
    putImages(smoothImage(640, 480), frame);
    return frame;
}

LiveMap someMap() {
    LiveMap map;
    map.path = {{1, pose}, {2, pose * pose}, {3, pose}};
    map.keyframes = {{1, pose}, {3, pose}};
    map.loops = {{1, 0}};
    map.covisibility = {{0, 1}};
    return map;
}

TEST(LiveMessages, framesArriveAsTheyWereSent) {
    const auto frame = std::get<LiveFrame>(decode(encode(someFrame())));
    EXPECT_EQ(frame.stamp_s, 1234.5);
    EXPECT_EQ(frame.keyframe, 7);
    EXPECT_EQ(frame.T_world_cam.R, pose.R);
    EXPECT_EQ(frame.T_world_cam.t, pose.t);
    ASSERT_EQ(frame.features.size(), 2U);
    EXPECT_EQ(frame.features[0].state, FeatureState::Lost);
    EXPECT_EQ(frame.features[1].v, 4);
    ASSERT_EQ(frame.statistics.size(), 2U);
    EXPECT_TRUE(frame.statistics[1].lost);
    EXPECT_EQ(frame.statistics[0].inliers, 300);
}

TEST(LiveMessages, imagesAreEveryOtherPixel) {
    const auto frame = std::get<LiveFrame>(decode(encode(someFrame())));
    EXPECT_EQ(frame.depth.size(), cv::Size(320, 240));
    EXPECT_EQ(frame.depth.at<std::uint16_t>(100, 50), 1000 + 10 * 200 + 100);
    EXPECT_EQ(frame.color.at<cv::Vec3b>(120, 160), cv::Vec3b(127, 127, 90));
    // A ray through the same place of the world.
    const CameraModel camera = imageCamera(frame);
    EXPECT_DOUBLE_EQ(camera.unproject(50, 100, 1).x(), CameraModel().unproject(100, 200, 1).x());
    EXPECT_EQ(camera.width, 320);
}

TEST(LiveMessages, smallImagesKeepEveryPixel) {
    LiveFrame frame;
    putImages(smoothImage(160, 120), frame);
    EXPECT_EQ(frame.step, 1);
    EXPECT_EQ(frame.depth.size(), cv::Size(160, 120));
    EXPECT_EQ(imageCamera(frame).pixelsPerRadian(), CameraModel().pixelsPerRadian());
}

TEST(LiveMessages, keyframesForTheMapHaveFewerPixelsThanPictures) {
    LiveFrame sent;
    sent.is_picture = false;
    putImages(smoothImage(640, 480), sent);
    const auto frame = std::get<LiveFrame>(decode(encode(sent)));
    EXPECT_FALSE(frame.is_picture);
    EXPECT_EQ(frame.step, 7);
    EXPECT_EQ(frame.color.size(), cv::Size(92, 69));
    EXPECT_EQ(frame.depth.at<std::uint16_t>(10, 20), 1000 + 10 * 70 + 140);
}

TEST(LiveMessages, aGrayCameraHasGrayImages) {
    RgbdImage image = smoothImage(640, 480);
    image.gray = cv::Mat(480, 640, CV_8UC1, cv::Scalar(77));
    image.color.release();
    LiveFrame sent;
    putImages(image, sent);
    const auto frame = std::get<LiveFrame>(decode(encode(sent)));
    EXPECT_EQ(imageCamera(frame).width, 320);
    EXPECT_EQ(frame.color.at<cv::Vec3b>(239, 319), cv::Vec3b(77, 77, 77));
}

TEST(LiveMessages, aFrameWithoutImagesIsAFrame) {
    const auto frame = std::get<LiveFrame>(decode(encode(LiveFrame())));
    EXPECT_TRUE(frame.depth.empty());
    EXPECT_THROW(imageCamera(frame), Error);
}

TEST(LiveMessages, mapsArriveAsTheyWereSent) {
    const auto map = std::get<LiveMap>(decode(encode(someMap())));
    ASSERT_EQ(map.path.size(), 3U);
    EXPECT_EQ(map.path[1].T_world_cam.t, (pose * pose).t);
    EXPECT_EQ(map.keyframes[1].stamp_s, 3);
    EXPECT_EQ(map.loops, someMap().loops);
    EXPECT_EQ(map.covisibility, someMap().covisibility);
}

TEST(LiveMessages, whatIsCutOffIsRefusedWhereverTheCutIs) {
    for (const LiveMessage& message : {LiveMessage(someFrame()), LiveMessage(someMap())}) {
        const std::string bytes = encode(message);
        for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50) {
            EXPECT_THROW(decode(bytes.substr(0, size)), Error) << size;
        }
        EXPECT_THROW(decode(bytes + '\0'), Error);
    }
    EXPECT_THROW(decode(std::string(100, '\xff')), Error);
}

TEST(LiveMessages, damagedOnesAreReadOrRefused) {
    std::mt19937 random(1);
    for (const std::string& message : {encode(someFrame()), encode(someMap())}) {
        int refused = 0;
        for (int trial = 0; trial < 300; ++trial) {
            std::string damaged = message;
            const std::size_t most = trial % 2 == 0 ? 500 : damaged.size();  // lengths lie in front
            damaged[random() % std::min(most, damaged.size())] = static_cast<char>(random());
            try {
                decode(damaged);
            } catch (const Error&) {
                ++refused;
            }
        }
        EXPECT_GT(refused, 0);
    }
}

TEST(LiveMessages, loopsToNowhereAreRefused) {
    LiveMap map = someMap();
    map.loops = {{0, 2}};
    EXPECT_THROW(decode(encode(map)), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
