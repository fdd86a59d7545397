#include "rgbd_graphslam/dataset/registration_check.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

constexpr int width = 320, height = 240;

struct Frame {
    cv::Mat3b color;
    cv::Mat1w depth;
};

/** Boxes of their own colour before a wall, with texture and noise on everything. */
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

std::optional<Eigen::Vector2d> misalignmentOf(int frames, cv::Point shift) {
    RegistrationCheck check;
    for (int i = 0; i < frames; ++i) {
        const Frame frame = boxes(i, shift);
        check.add(frame.color, frame.depth);
    }
    return check.misalignment();
}

TEST(RegistrationCheck, registeredDepthIsNoCauseForAlarm) {
    EXPECT_FALSE(misalignmentOf(6, {0, 0}));
    EXPECT_FALSE(misalignmentOf(6, {2, -2})) << "cameras' stamps and calibrations do as much";
}

TEST(RegistrationCheck, aShiftIsFoundWithItsDirection) {
    for (const cv::Point shift : {cv::Point(10, 0), cv::Point(-12, 3), cv::Point(0, 15)}) {
        const auto found = misalignmentOf(6, shift);
        ASSERT_TRUE(found) << shift;
        EXPECT_NEAR(found->x(), shift.x, 2);
        EXPECT_NEAR(found->y(), shift.y, 2);
    }
}

TEST(RegistrationCheck, fewOrFlatFramesTellNothing) {
    EXPECT_FALSE(misalignmentOf(2, {10, 0}));
    RegistrationCheck check;
    for (int i = 0; i < 10; ++i) {
        check.add(boxes(i, {}).color, cv::Mat1w(height, width, std::uint16_t{9000}));
    }
    EXPECT_FALSE(check.misalignment());
}

TEST(RegistrationCheck, depthOfOtherScenesTellsNothing) {
    RegistrationCheck check;
    for (int i = 0; i < 10; ++i) check.add(boxes(i, {}).color, boxes(i + 100, {}).depth);
    EXPECT_FALSE(check.misalignment());
}

}  // namespace
}  // namespace rgbd_graphslam
