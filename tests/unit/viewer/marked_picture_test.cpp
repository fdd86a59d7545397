#include "rgbd_graphslam/viewer/marked_picture.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

constexpr Rgba margin = {1, 2, 3, 255}, red = {255, 0, 0, 255};
const cv::Vec4b margin_pixel(1, 2, 3, 255), red_pixel(255, 0, 0, 255), green_pixel(0, 200, 0, 255);

cv::Mat3b green(int width, int height) {
    return cv::Mat3b(height, width, cv::Vec3b(0, 200, 0));
}

TEST(FittedPicture, keepsItsShapeInTheMiddle) {
    const cv::Mat4b wide = fittedPicture(green(640, 320), {}, {100, 80}, margin);
    ASSERT_EQ(wide.size(), cv::Size(100, 80));
    EXPECT_EQ(wide(5, 50), margin_pixel);
    EXPECT_EQ(wide(75, 50), margin_pixel);
    EXPECT_EQ(wide(40, 0), green_pixel);
    EXPECT_EQ(wide(40, 99), green_pixel);
    EXPECT_EQ(fittedPicture(green(20, 40), {}, {100, 80}, margin)(40, 20), margin_pixel);
}

TEST(FittedPicture, marksAreWhereTheyAreInTheImage) {
    const cv::Mat4b picture =
        fittedPicture(green(640, 320), {{0.5f, 0.5f, red}}, {100, 80}, margin);
    EXPECT_EQ(picture(40, 50), red_pixel);
    EXPECT_EQ(picture(40, 55), green_pixel);
}

TEST(FittedPicture, marksAtItsEdgeAndBeyondAreCut) {
    for (const float place : {-3.f, 0.f, 1.f, 4.f}) {
        const cv::Mat4b picture =
            fittedPicture(green(640, 320), {{place, place, red}}, {100, 80}, margin);
        EXPECT_EQ(picture(5, 50), margin_pixel);
        EXPECT_EQ(picture(40, 50), green_pixel);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
