#include "rgbd_graphslam/report/keyframe_sheet.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

cv::Mat plain(int gray) {
    return cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(gray));
}

TEST(KeyframeSheet, isEmptyWithoutPictures) {
    EXPECT_TRUE(KeyframeSheet().picture().empty());
}

TEST(KeyframeSheet, showsPicturesInOrder) {
    KeyframeSheet sheet;
    for (int i = 0; i < 10; ++i) sheet.add(i, i, plain(20 * i));
    const cv::Mat3b picture = sheet.picture();
    ASSERT_EQ(picture.size(), cv::Size(8 * 160, 2 * 120));
    EXPECT_EQ(picture(20, 80)[0], 0);
    EXPECT_EQ(picture(20, 7 * 160 + 80)[0], 140);
    EXPECT_EQ(picture(140, 160 + 80)[0], 180);
    EXPECT_EQ(picture(140, 2 * 160 + 80)[0], 255);  // none
}

TEST(KeyframeSheet, spreadsOverALongRun) {
    KeyframeSheet sheet;
    for (int i = 0; i < 3000; ++i) sheet.add(i, i, plain(i * 250 / 3000));
    const cv::Mat3b picture = sheet.picture();
    const int rows = picture.rows / 120;
    EXPECT_GE(rows, 3);
    EXPECT_LE(rows, 6);
    EXPECT_LT(picture(20, 80)[0], 10);
    EXPECT_NEAR(picture((rows / 2) * 120 + 20, 80)[0], 125, 40);
}

TEST(KeyframeSheet, takesPicturesOfAnySize) {
    KeyframeSheet sheet;
    sheet.add(0, 0, cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(9)));
    sheet.add(1, 1, plain(7));
    EXPECT_FALSE(sheet.picture().empty());
}

}  // namespace
}  // namespace rgbd_graphslam
