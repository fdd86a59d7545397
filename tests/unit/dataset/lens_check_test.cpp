#include "rgbd_graphslam/dataset/lens_check.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

namespace rgbd_graphslam {
namespace {

Intrinsics camera(double k1 = 0) {
    Intrinsics in;
    in.width = 640, in.height = 480;
    in.fx = in.fy = 525;
    in.cx = 319.5, in.cy = 239.5;
    std::get<BrownLens>(in.lens).coefficients[0] = k1;
    return in;
}

/** Fills the plane below a curve of pixels, whose edge is then seen. */
void paint(cv::Mat& image, const std::vector<cv::Point2d>& curve, int gray) {
    constexpr int shift = 4;
    std::vector<cv::Point> corners;
    for (const cv::Point2d& p : curve) corners.emplace_back(p * (1 << shift));
    cv::polylines(image, corners, false, cv::Scalar::all(gray), 7, cv::LINE_AA, shift);
}

/** Bars that are straight in the world, seen through a lens. */
cv::Mat bars(unsigned seed, double k1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-0.7, 0.7);
    const CameraModel lens(camera(k1));
    cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(40));
    for (int i = 0; i < 12; ++i) {
        const Eigen::Vector2d from(place(random), place(random)), to(place(random), place(random));
        std::vector<cv::Point2d> curve;
        for (double t = -1; t <= 2; t += 0.02) {
            const Eigen::Vector2d at = lens.project((from + t * (to - from)).homogeneous());
            curve.emplace_back(at.x(), at.y());
        }
        paint(image, curve, 90 + 10 * i);
    }
    return image;
}

/** Round things of all sizes. */
cv::Mat rings(unsigned seed) {
    std::mt19937 random(seed);
    cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(40));
    for (int i = 0; i < 8; ++i) {
        const cv::Point center(int(random() % 640), int(random() % 480));
        cv::circle(image, center, 60 + int(random() % 200), cv::Scalar::all(90 + 15 * i), 5,
                   cv::LINE_AA);
    }
    return image;
}

LensCheck checked(int frames, double true_k1, double calibrated_k1) {
    LensCheck check{CameraModel(camera(calibrated_k1))};
    for (int i = 0; i < frames; ++i) check.add(bars(static_cast<unsigned>(i), true_k1));
    return check;
}

TEST(LensCheck, aMissingLensIsFoundWithItsValue) {
    for (const double k1 : {-0.25, -0.1, 0.08, 0.2}) {
        const auto found = checked(20, k1, 0).finding();
        ASSERT_TRUE(found) << k1;
        EXPECT_NEAR(found->k1 / k1, 1, 0.1);
        EXPECT_LT(found->k1_sigma, 0.02);
        EXPECT_EQ(std::signbit(found->border_px), std::signbit(k1));
    }
    EXPECT_NE(toText({0.2, 0.01, 24}).find("k1 = 0.20 (+- 0.01)"), std::string::npos);
}

TEST(LensCheck, whatACalibrationLeavesIsFound) {
    EXPECT_FALSE(checked(20, 0.2, 0.2).finding());
    const auto found = checked(20, 0, 0.1).finding();
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->k1, -0.1, 0.03);
}

TEST(LensCheck, straightEdgesAreNoCauseForAlarm) {
    const auto estimate = checked(20, 0, 0).estimate();
    ASSERT_TRUE(estimate);
    EXPECT_NEAR(estimate->k1, 0, 0.01);
    EXPECT_FALSE(checked(20, 0, 0).finding());
}

TEST(LensCheck, roundThingsAreNoCauseForAlarm) {
    LensCheck check{CameraModel(camera())};
    for (unsigned i = 0; i < 40; ++i) check.add(rings(i));
    EXPECT_FALSE(check.finding());
}

TEST(LensCheck, theSameFewCurvesInEveryFrameAreNoCauseForAlarm) {
    LensCheck check{CameraModel(camera())};
    cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(40));
    cv::ellipse(image, {320, 1400}, {1300, 1300}, 0, 0, 360, cv::Scalar::all(200), 5, cv::LINE_AA);
    for (int i = 0; i < 40; ++i) check.add(image);
    EXPECT_FALSE(check.finding());
}

TEST(LensCheck, fewFramesOrOtherSizesTellNothing) {
    EXPECT_FALSE(checked(5, 0.2, 0).finding());
    LensCheck check{CameraModel(camera())};
    EXPECT_FALSE(check.estimate());
    for (int i = 0; i < 20; ++i) check.add(cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(0)));
    EXPECT_FALSE(check.estimate());
}

}  // namespace
}  // namespace rgbd_graphslam
