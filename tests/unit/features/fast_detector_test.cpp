#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "../../../libs/features/src/fast_detector.h"

namespace rgbd_graphslam {
namespace {

constexpr int circle[16][2] = {{0, -3}, {1, -3},  {2, -2},  {3, -1}, {3, 0},  {3, 1},
                               {2, 2},  {1, 3},   {0, 3},   {-1, 3}, {-2, 2}, {-3, 1},
                               {-3, 0}, {-3, -1}, {-2, -2}, {-1, -3}};

/** The definition, one pixel at a time. */
int scoreByDefinition(const cv::Mat& image, int x, int y) {
    int best = 0;
    for (const int sign : {1, -1}) {
        for (int start = 0; start < 16; ++start) {
            int least = 255;
            for (int i = start; i < start + 9; ++i) {
                const int p = image.at<std::uint8_t>(y + circle[i % 16][1], x + circle[i % 16][0]);
                least = std::min(least, sign * (p - image.at<std::uint8_t>(y, x)));
            }
            best = std::max(best, least);
        }
    }
    return best;
}

cv::Mat noisyImage(int width, int height) {
    cv::Mat image(height, width, CV_8UC1);
    cv::RNG(5).fill(image, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(image, image, {5, 5}, 1.2);
    return image;
}

TEST(DetectFast, givesThePeaksOfTheDefinition) {
    const cv::Mat image = noisyImage(150, 60);
    const cv::Rect area(5, 4, 139, 50);
    constexpr int threshold = 10;
    std::vector<FastCorner> corners;
    detectFast(image, area, threshold, corners);
    cv::Mat scores(image.size(), CV_32SC1, cv::Scalar(0));
    for (int y = area.y; y < area.br().y; ++y) {
        for (int x = area.x; x < area.br().x; ++x) {
            const int score = scoreByDefinition(image, x, y);
            scores.at<int>(y, x) = score >= threshold ? score : 0;
        }
    }
    std::size_t next = 0;
    for (int y = area.y; y < area.br().y; ++y) {
        for (int x = area.x; x < area.br().x; ++x) {
            const int s = scores.at<int>(y, x);
            bool peak = s > 0;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const int n = scores.at<int>(y + dy, x + dx);
                    const bool earlier = dy < 0 || (dy == 0 && dx < 0);
                    if (dx || dy) peak = peak && (earlier ? s > n : s >= n);
                }
            }
            if (!peak) continue;
            ASSERT_LT(next, corners.size());
            EXPECT_EQ(corners[next].x, x);
            EXPECT_EQ(corners[next].y, y);
            EXPECT_EQ(corners[next].score, s);
            ++next;
        }
    }
    EXPECT_EQ(next, corners.size());
    EXPECT_GT(next, 50u);
}

TEST(DetectFast, worksInAreasNarrowerThanARegister) {
    const cv::Mat image = noisyImage(40, 40);
    for (const int width : {1, 7, 31, 33}) {
        std::vector<FastCorner> corners;
        detectFast(image, {3, 3, width, 30}, 5, corners);
        for (const FastCorner& c : corners) {
            EXPECT_LT(c.x, 3 + width);
            EXPECT_EQ(c.score, scoreByDefinition(image, c.x, c.y));
        }
    }
}

}  // namespace
}  // namespace rgbd_graphslam
