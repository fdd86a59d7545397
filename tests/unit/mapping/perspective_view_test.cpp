#include "rgbd_graphslam/mapping/perspective_view.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace rgbd_graphslam {
namespace {

/** Points of one color, 1 cm apart. \param z of the sheet, m */
PointMap sheet(float z, std::array<std::uint8_t, 3> rgb) {
    PointMap points;
    for (int i = 0; i < 200; ++i)
        for (int j = 0; j < 100; ++j)
            points.push_back(
                {{0.01f * static_cast<float>(i), 0.01f * static_cast<float>(j), z}, rgb});
    return points;
}

double shareLike(const cv::Mat3b& picture, const cv::Vec3b& bgr) {
    int count = 0;
    for (const cv::Vec3b& pixel : picture) count += pixel == bgr;
    return count / static_cast<double>(picture.total());
}

TEST(PerspectiveView, closesSurfacesAndFillsThePicture) {
    const cv::Mat3b picture = perspectiveView({}, sheet(0.5f, {200, 30, 20}), 0.01, {600, 400});
    EXPECT_EQ(picture.size(), cv::Size(600, 400));
    EXPECT_GT(shareLike(picture, {20, 30, 200}), 0.25);
}

TEST(PerspectiveView, hidesWhatIsBehindAndWhatIsAboveHeads) {
    PointMap points = sheet(0.5f, {200, 30, 20});
    const PointMap above = sheet(0.6f, {30, 200, 20}), ceiling = sheet(2.5f, {1, 2, 3});
    points.insert(points.begin(), above.begin(), above.end());
    points.insert(points.end(), ceiling.begin(), ceiling.end());
    const cv::Mat3b picture = perspectiveView({}, points, 0.01, {600, 400});
    EXPECT_GT(shareLike(picture, {20, 200, 30}), 0.2);
    EXPECT_LT(shareLike(picture, {20, 30, 200}), 0.05);
    EXPECT_EQ(shareLike(picture, {3, 2, 1}), 0);
}

TEST(PerspectiveView, takesNothingAtAll) {
    EXPECT_EQ(perspectiveView({}, {}, 0.01, {60, 40}).size(), cv::Size(60, 40));
}

}  // namespace
}  // namespace rgbd_graphslam
