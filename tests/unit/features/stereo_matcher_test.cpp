/** Disparities of points, against pairs whose disparity is known in every pixel. */
#include "rgbd_graphslam/features/stereo_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "rgbd_graphslam/features/frame_builder.h"
#include "rgbd_graphslam/geometry/stereo_depth.h"

namespace rgbd_graphslam {
namespace {

constexpr int width = 400, height = 120, largest = 96;

/** A picture that is defined between its pixels, too. */
class Texture {
  public:
    explicit Texture(std::uint64_t seed) {
        cv::RNG random(seed);
        for (Wave& w : waves_) {
            const double frequency = random.uniform(0.1, 0.9), way = random.uniform(0.0, M_PI);
            w = {frequency * std::cos(way), frequency * std::sin(way), random.uniform(0.0, 6.28)};
        }
    }
    double at(double x, double y) const {
        double sum = 0;
        for (const Wave& w : waves_) sum += std::sin(w.x * x + w.y * y + w.phase);
        return 128 + 20 * sum;
    }

  private:
    struct Wave {
        double x = 0, y = 0, phase = 0;
    };
    Wave waves_[30];
};

/** Disparity at (u, v) of the left image: first + across u + along v. */
struct Slope {
    double first = 20, across = 0, along = 0;
    double at(double u, double v) const { return first + across * u + along * v; }
};

struct Pair {
    cv::Mat left = cv::Mat(height, width, CV_8UC1), right = cv::Mat(height, width, CV_8UC1);
};

Pair film(const Slope& slope, std::uint64_t seed = 1, double noise = 0, double brighter = 0) {
    const Texture texture(seed);
    cv::RNG random(seed + 100);
    Pair pair;
    const auto gray = [&](double value) {
        return cv::saturate_cast<std::uint8_t>(value + random.gaussian(noise));
    };
    for (int v = 0; v < height; ++v) {
        for (int u = 0; u < width; ++u) {
            pair.left.at<std::uint8_t>(v, u) = gray(texture.at(u, v));
            const double seen = (u + slope.first + slope.along * v) / (1 - slope.across);
            pair.right.at<std::uint8_t>(v, u) = gray(texture.at(seen, v) + brighter);
        }
    }
    return pair;
}

/** Errors (px) of points all over the image, and how many are found of how many. */
struct Errors {
    std::vector<double> px;
    int asked = 0;

    double rms() const {
        double sum = 0;
        for (const double e : px) sum += e * e;
        return std::sqrt(sum / static_cast<double>(px.size()));
    }
    double mean() const {
        double sum = 0;
        for (const double e : px) sum += e;
        return sum / static_cast<double>(px.size());
    }
    double found() const { return static_cast<double>(px.size()) / asked; }
};

Errors errorsOf(const Pair& pair, const Slope& slope) {
    const StereoMatcher matcher(pair.left, pair.right, largest);
    Errors errors;
    for (double v = 20.3; v < height - 20; v += 7.7) {
        for (double u = 130.1; u < width - 20; u += 9.3) {
            ++errors.asked;
            const auto found = matcher.disparityAt(static_cast<float>(u), static_cast<float>(v));
            if (found) errors.px.push_back(*found - slope.at(u, v));
        }
    }
    return errors;
}

TEST(StereoMatcher, findsDisparitiesBetweenPixels) {
    for (const double disparity : {1.3, 20.25, 20.5, 57.9}) {
        const Slope slope{disparity, 0, 0};
        const Errors errors = errorsOf(film(slope), slope);
        EXPECT_GT(errors.found(), 0.95) << disparity;
        EXPECT_LT(errors.rms(), 0.03) << disparity;
    }
}

TEST(StereoMatcher, isRightOnFloorsAndWallsSeenAtAnAngle) {
    for (const Slope& slope : {Slope{30, 0.1, 0}, Slope{50, -0.1, 0}, Slope{10, 0, 0.3}}) {
        const Errors errors = errorsOf(film(slope), slope);
        EXPECT_GT(errors.found(), 0.9);
        EXPECT_LT(errors.rms(), 0.05);
        EXPECT_LT(std::abs(errors.mean()), 0.01);
    }
}

TEST(StereoMatcher, doesNotMindNoiseAndExposure) {
    const Slope slope{23.4, 0, 0.1};
    for (std::uint64_t seed : {1, 2, 3}) {
        const Errors errors = errorsOf(film(slope, seed, 4, 15), slope);
        EXPECT_GT(errors.found(), 0.8) << seed;
        EXPECT_LT(errors.rms(), 0.15) << seed;
        EXPECT_LT(std::abs(errors.mean()), 0.02) << seed;
    }
}

TEST(StereoMatcher, findsNothingInOtherImagesAndBlankOnes) {
    Pair pair = film({});
    pair.right = film({}, 2).right;
    EXPECT_LT(errorsOf(pair, {}).found(), 0.02);
    pair.left = 128;
    pair.right = 128;
    EXPECT_EQ(errorsOf(pair, {}).found(), 0);
}

/** A picket fence looks the same one picket on. */
TEST(StereoMatcher, isSilentWhereARowRepeatsItself) {
    Pair pair;
    for (int u = 0; u < width; ++u) {
        pair.left.col(u) = 128 + 80 * std::sin(u * 2 * M_PI / 16);
        pair.right.col(u) = 128 + 80 * std::sin((u + 20) * 2 * M_PI / 16);
    }
    EXPECT_EQ(errorsOf(pair, {}).found(), 0);
}

TEST(StereoMatcher, staysAwayFromBordersAndInfinity) {
    const Pair pair = film({0, 0, 0});
    const StereoMatcher matcher(pair.left, pair.right, largest);
    for (const auto& [u, v] : {std::pair(2, 60), {60, 2}, {width - 3, 60}, {60, height - 1}}) {
        EXPECT_FALSE(matcher.disparityAt(static_cast<float>(u), static_cast<float>(v)));
    }
    EXPECT_FALSE(matcher.disparityAt(200, 60));  // a disparity of zero
}

RgbdImage imageOf(const Pair& pair) {
    RgbdImage image;
    image.gray = pair.left;
    image.right = pair.right;
    image.disparity_m_px = 40;
    return image;
}

TEST(StereoFrames, haveDepthByMatchingAtKeypoints) {
    const Pair pair = film({20, 0, 0});
    const Intrinsics camera{width, height, 200, 200, width / 2.0, height / 2.0, {}};
    const FrameBuilder builder(FeatureOptions(), camera);
    const Frame frame = builder.build(imageOf(pair));
    const auto seen = std::count_if(frame.keypoints.begin(), frame.keypoints.end(),
                                    [](const Keypoint& k) { return k.depth_m > 0; });
    EXPECT_GT(seen, 0.8 * static_cast<double>(frame.keypoints.size()));
    for (const Keypoint& k : frame.keypoints) {
        if (k.depth_m > 0) {
            EXPECT_NEAR(k.depth_m, 2, 0.02);
        }
    }
    // The image as a whole has depth, too, when it is asked for.
    const DenseView view = frame.view.get();
    EXPECT_GT(view.depthShare(), 0.7);
}

TEST(DenseStereoDepth, isThatOfThePlane) {
    const Slope slope{20, 0, 0.1};
    const RgbdImage image = withDenseDepth(imageOf(film(slope)));
    ASSERT_EQ(image.depth.size(), image.gray.size());
    int seen = 0, wrong = 0, all = 0;
    for (int v = 10; v < height - 10; ++v) {
        for (int u = 60; u < width - 10; ++u, ++all) {
            const double z = image.depth.at<std::uint16_t>(v, u) * image.depth_unit_m;
            if (z == 0) continue;
            ++seen;
            wrong += std::abs(40 / z - slope.at(u, v)) > 0.5;
        }
    }
    EXPECT_GT(seen, 0.9 * all);
    EXPECT_LT(wrong, 0.01 * seen);
}

TEST(DenseStereoDepth, fitsInto16BitsForWideBaselines) {
    EXPECT_EQ(stereoDepthUnit(40), 0.001);
    EXPECT_LE(380 / stereoDepthUnit(380), 65535);
    EXPECT_EQ(largestDisparity(600, 40, 0.4), 100);
    EXPECT_EQ(largestDisparity(240, 400, 0.4), 80);
}

}  // namespace
}  // namespace rgbd_graphslam
