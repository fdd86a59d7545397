#include "rgbd_graphslam/dataset/registration_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/dataset/lag_check.h"

namespace rgbd_graphslam {
namespace {

constexpr int width = 320, height = 240;

struct Frame {
    cv::Mat3b color;
    cv::Mat1w depth;
};

/** Boxes of their own color before a wall, with texture and noise on everything. */
Frame boxes(int seed, cv::Point depth_shift) {
    cv::RNG random(seed);
    Frame frame{cv::Mat3b(height, width, cv::Vec3b(120, 120, 120)),
                cv::Mat1w(height, width, std::uint16_t{15000})};
    for (int i = 0; i < 8; ++i) {
        const cv::Rect box(random.uniform(0, width), random.uniform(0, height),
                           random.uniform(20, 80), random.uniform(20, 80));
        cv::rectangle(
            frame.color, box,
            cv::Scalar(random.uniform(0, 255), random.uniform(0, 255), random.uniform(0, 255)),
            cv::FILLED);
        cv::rectangle(frame.depth, box + depth_shift, cv::Scalar(random.uniform(4000, 12000)),
                      cv::FILLED);
    }
    cv::Mat3b noise(height, width);
    random.fill(noise, cv::RNG::UNIFORM, 0, 40);
    frame.color += noise;
    return frame;
}

/** Depth as a camera of `scale` times the focal length would see it. */
cv::Mat1w scaled(const cv::Mat1w& depth, double scale) {
    const cv::Mat1d motion = (cv::Mat1d(2, 3) << scale, 0, 0.5 * (1 - scale) * width, 0, scale,
                              0.5 * (1 - scale) * height);
    cv::Mat1w result;
    cv::warpAffine(depth, result, motion, depth.size(), cv::INTER_NEAREST);
    return result;
}

std::optional<Misregistration> findingOf(int frames, double scale, cv::Point shift) {
    RegistrationCheck check;
    for (int i = 0; i < frames; ++i) {
        const Frame frame = boxes(i, shift);
        check.add(frame.color, scaled(frame.depth, scale));
    }
    return check.finding();
}

TEST(RegistrationCheck, registeredDepthIsNoCauseForAlarm) {
    EXPECT_FALSE(findingOf(8, 1, {0, 0}));
    EXPECT_FALSE(findingOf(8, 1, {2, -2})) << "cameras' stamps and calibrations do as much";
    EXPECT_FALSE(findingOf(8, 1.015, {0, 0}));
}

TEST(RegistrationCheck, aShiftIsFoundWithItsDirection) {
    for (const cv::Point shift :
         {cv::Point(10, 0), cv::Point(-12, 3), cv::Point(0, 15), cv::Point(40, 0)}) {
        const auto found = findingOf(8, 1, shift);
        ASSERT_TRUE(found) << shift;
        EXPECT_FALSE(found->isScaled()) << found->scale;
        EXPECT_NEAR(found->shift_px.x(), shift.x, 2);
        EXPECT_NEAR(found->shift_px.y(), shift.y, 2);
        EXPECT_EQ(toText(*found, 300).find("focal"), std::string::npos);
    }
}

TEST(RegistrationCheck, aScaleIsFound) {
    for (const double scale : {0.637, 0.8, 0.95, 1.05, 1.3, 1.57}) {
        const auto found = findingOf(8, scale, {0, 0});
        ASSERT_TRUE(found) << scale;
        EXPECT_NEAR(found->scale / scale, 1, 0.03);
        EXPECT_LT(found->shift_px.norm(), 5);
    }
    EXPECT_EQ(toText(*findingOf(8, 0.637, {3, 1}), 603).rfind("depth seems to be 0.6", 0), 0u);
}

TEST(RegistrationCheck, fewOrFlatFramesTellNothing) {
    EXPECT_FALSE(findingOf(2, 1, {10, 0}));
    RegistrationCheck check;
    for (int i = 0; i < 10; ++i) {
        check.add(boxes(i, {}).color, cv::Mat1w(height, width, std::uint16_t{9000}));
    }
    EXPECT_FALSE(check.finding());
}

TEST(RegistrationCheck, depthOfOtherScenesTellsNothing) {
    for (int trial = 0; trial < 5; ++trial) {
        RegistrationCheck check;
        for (int i = 0; i < 10; ++i) {
            check.add(boxes(i + 1000 * trial, {}).color, boxes(i + 1000 * trial + 100, {}).depth);
        }
        EXPECT_FALSE(check.finding());
    }
}

/** A camera that turns to and fro before boxes, 30 frames a second. */
std::optional<DepthLag> lagOf(int frames, int late, double amplitude_px) {
    const Frame scene = boxes(3, {});
    const auto view = [&](const cv::Mat& image, int frame) {
        const double angle = 0.09 * frame;
        const cv::Mat1d motion = (cv::Mat1d(2, 3) << 1, 0, amplitude_px * std::sin(angle), 0, 1,
                                  0.4 * amplitude_px * std::sin(1.7 * angle));
        cv::Mat result;
        cv::warpAffine(image, result, motion, image.size(), cv::INTER_NEAREST, cv::BORDER_REFLECT);
        return result;
    };
    LagCheck check(frames);
    for (int i = 0; i < frames; ++i) {
        check.add(i / 30.0, view(scene.color, i), view(scene.depth, std::max(0, i - late)));
    }
    return check.finding();
}

TEST(LagCheck, lateAndEarlyDepthIsFound) {
    for (const int late : {1, 2, 3, 4, 5, 10, 15}) {
        const auto found = lagOf(120, late, 40);
        ASSERT_TRUE(found) << late;
        EXPECT_EQ(found->frames, late);
        EXPECT_NEAR(found->seconds, late / 30.0, 1e-6);
    }
}

TEST(LagCheck, depthInTimeAndCamerasAtRestAreNoCauseForAlarm) {
    EXPECT_FALSE(lagOf(120, 0, 40));
    EXPECT_FALSE(lagOf(120, 0, 4));
    EXPECT_FALSE(lagOf(120, 5, 0)) << "nothing moves";
    EXPECT_FALSE(lagOf(8, 0, 40));
    EXPECT_FALSE(LagCheck(0).finding());
}

}  // namespace
}  // namespace rgbd_graphslam
