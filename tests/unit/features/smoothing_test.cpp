#include "../../../libs/features/src/smoothing.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

TEST(Smoothing, isOpenCvsToTheBit) {
    cv::RNG random(5);
    for (const cv::Size size : {cv::Size(5, 5), cv::Size(42, 42), cv::Size(53, 47), {640, 480}}) {
        cv::Mat image(size, CV_8UC1), expected;
        random.fill(image, cv::RNG::UNIFORM, 0, 256);
        cv::GaussianBlur(image, expected, {5, 5}, 0);
        cv::Mat smoothed = expected.clone();
        const cv::Rect inner(smoothing_radius, smoothing_radius, size.width - 2 * smoothing_radius,
                             size.height - 2 * smoothing_radius);
        smoothed(inner) = 0;
        smooth(image, smoothed);
        EXPECT_EQ(cv::norm(smoothed, expected, cv::NORM_INF), 0) << size;
    }
}

TEST(Smoothing, keepsWhite) {
    const cv::Mat image(20, 20, CV_8UC1, cv::Scalar(255));
    cv::Mat smoothed = image.clone();
    smooth(image, smoothed);
    EXPECT_EQ(cv::norm(smoothed, image, cv::NORM_INF), 0);
}

TEST(Smoothing, leavesTheBorder) {
    const cv::Mat image(20, 30, CV_8UC1, cv::Scalar(100));
    cv::Mat smoothed = cv::Mat::zeros(image.size(), CV_8UC1);
    smooth(image, smoothed);
    EXPECT_EQ(cv::countNonZero(smoothed), 26 * 16);
}

}  // namespace
}  // namespace rgbd_graphslam
