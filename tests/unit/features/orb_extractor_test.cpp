#include "rgbd_graphslam/features/orb_extractor.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>
#include <thread>

namespace rgbd_graphslam {
namespace {

/** Blurred random squares: corners of every contrast all over the image. */
cv::Mat texturedImage(int width = 640, int height = 480) {
    cv::RNG random(7);
    cv::Mat image(height, width, CV_8UC1, cv::Scalar(120));
    for (int i = 0; i < 900; ++i) {
        const cv::Rect box(random.uniform(-20, width), random.uniform(-20, height),
                           random.uniform(6, 60), random.uniform(6, 60));
        cv::rectangle(image, box, cv::Scalar(random.uniform(0, 255)), cv::FILLED);
    }
    cv::GaussianBlur(image, image, {3, 3}, 0.8);
    return image;
}

TEST(OrbExtractor, findsAboutTheWantedNumberSpreadOverTheImage) {
    FeatureOptions options;
    const auto features = OrbExtractor(options).extract(texturedImage());
    EXPECT_EQ(features.corners.size(), features.descriptors.size());
    EXPECT_NEAR(static_cast<double>(features.corners.size()), options.count, 0.05 * options.count);
    std::set<std::pair<int, int>> cells;
    for (const Corner& c : features.corners) {
        cells.insert({static_cast<int>(c.u) / 80, static_cast<int>(c.v) / 80});
    }
    EXPECT_EQ(cells.size(), 48u) << "every 80 px cell of 640x480 has a keypoint";
}

TEST(OrbExtractor, findsFaintCornersWhereThereIsNoOther) {
    cv::Mat image(480, 640, CV_8UC1, cv::Scalar(100));
    cv::rectangle(image, {300, 200, 60, 60}, cv::Scalar(112), cv::FILLED);
    EXPECT_GE(OrbExtractor(FeatureOptions{}).extract(image).corners.size(), 4u);
}

TEST(OrbExtractor, givesNothingOnAPlainOrTinyImage) {
    const OrbExtractor extractor(FeatureOptions{});
    EXPECT_TRUE(extractor.extract(cv::Mat(480, 640, CV_8UC1, cv::Scalar(90))).corners.empty());
    EXPECT_TRUE(extractor.extract(texturedImage(20, 20)).corners.empty());
}

TEST(OrbExtractor, placesACornerBelowThePixel) {
    constexpr int zoom = 8;
    FeatureOptions options;
    options.levels = 1;
    for (int shift = 0; shift < zoom; ++shift) {
        cv::Mat large(100 * zoom, 100 * zoom, CV_8UC1, cv::Scalar(60)), image;
        const int edge = 50 * zoom + shift;
        cv::rectangle(large, {edge, edge, 400, 400}, cv::Scalar(180), cv::FILLED);
        cv::resize(large, image, {100, 100}, 0, 0, cv::INTER_AREA);
        cv::GaussianBlur(image, image, {5, 5}, 1.0);
        const auto features = OrbExtractor(options).extract(image);
        ASSERT_FALSE(features.corners.empty());
        // The edge lies between pixel centers: (edge / zoom) in pixel areas is 0.5 less in centers.
        const double truth = static_cast<double>(edge) / zoom - 0.5;
        double nearest = 10;
        for (const Corner& c : features.corners) {
            nearest = std::min(nearest, std::hypot(c.u - truth, c.v - truth));
        }
        EXPECT_LT(nearest, 0.9) << "shift of " << shift << "/8 px";
    }
}

TEST(OrbExtractor, describesARotatedImageAlike) {
    const cv::Mat image = texturedImage(480, 480);
    cv::Mat rotated;
    cv::rotate(image, rotated, cv::ROTATE_90_CLOCKWISE);
    const OrbExtractor extractor(FeatureOptions{});
    const auto a = extractor.extract(image), b = extractor.extract(rotated);
    int met = 0, alike = 0;
    for (std::size_t i = 0; i < a.corners.size(); ++i) {
        for (std::size_t j = 0; j < b.corners.size(); ++j) {
            const bool same = a.corners[i].octave == b.corners[j].octave &&
                              std::abs(479 - a.corners[i].v - b.corners[j].u) < 1 &&
                              std::abs(a.corners[i].u - b.corners[j].v) < 1;
            if (!same) continue;
            ++met;
            alike += hammingDistance(a.descriptors[i], b.descriptors[j]) < 40;
        }
    }
    EXPECT_GT(met, 500);
    EXPECT_GT(alike, 0.9 * met);
}

TEST(OrbExtractor, givesTheSameOnEveryThread) {
    const cv::Mat image = texturedImage();
    const OrbExtractor extractor(FeatureOptions{});
    const auto expected = extractor.extract(image);
    std::vector<OrbFeatures> results(3);
    std::vector<std::thread> threads;
    for (auto& result : results) {
        threads.emplace_back([&] { result = extractor.extract(image); });
    }
    for (auto& thread : threads) thread.join();
    for (const auto& result : results) EXPECT_EQ(result.descriptors, expected.descriptors);
}

TEST(OrbExtractor, dependsOnNothingButTheImage) {
    cv::Mat image(480, 640, CV_8UC1);
    cv::RNG(3).fill(image, cv::RNG::UNIFORM, 0, 256);  // corners up to the border
    FeatureOptions options;
    options.count = 10000;
    const OrbExtractor extractor(options);
    std::vector<OrbFeatures> found(2);
    for (std::size_t i = 0; i < found.size(); ++i) {
        mallopt(M_PERTURB, i == 0 ? 1 : 0xaa);  // what new memory holds
        std::thread([&] { found[i] = extractor.extract(image); }).join();
    }
    mallopt(M_PERTURB, 0);
    EXPECT_EQ(found[0].descriptors, found[1].descriptors);
}

}  // namespace
}  // namespace rgbd_graphslam
