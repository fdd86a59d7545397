#include "rgbd_graphslam/features/patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace rgbd_graphslam {
namespace {

using Texture = std::function<double(double, double)>;

/** Smooth waves in all directions, 6 px and longer, about gray 120. */
double waves(double x, double y) {
    return 120 + 40 * std::sin(0.9 * x + 0.3 * y) + 30 * std::cos(0.4 * x - 0.8 * y + 1);
}

/** What an image shows whose pixel (8, 8) lies at (x, y) of the texture.
 *  \param corner of the patch
 *  \param scale of the texture a pixel, \param roll_rad clockwise */
Patch patchAt(const Texture& texture, double x, double y, cv::Point2f corner = {0, 0},
              double scale = 1, double roll_rad = 0) {
    Patch patch;
    patch.corner = corner;
    const double c = scale * std::cos(roll_rad), s = scale * std::sin(roll_rad);
    for (int j = 0; j < Patch::side; ++j) {
        for (int i = 0; i < Patch::side; ++i) {
            const double u = i - Patch::center, v = j - Patch::center;
            patch.gray[Patch::side * j + i] = static_cast<std::uint8_t>(
                std::lround(texture(x + c * u + s * v, y - s * u + c * v)));
        }
    }
    return patch;
}

TEST(Patch, isFoundToATwentiethOfAPixel) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(-20, 20), within(-0.5, 0.5);
    for (int trial = 0; trial < 200; ++trial) {
        const float x = anywhere(random), y = anywhere(random);
        const cv::Point2f shift(within(random), within(random));
        const cv::Point2f corner(within(random), within(random)), guess(within(random), 0);
        const auto offset = alignPatch(patchAt(waves, x, y, corner), {},
                                       patchAt(waves, x - shift.x, y - shift.y, guess));
        ASSERT_TRUE(offset) << "trial " << trial;
        EXPECT_LT(cv::norm(guess + *offset - (corner + shift)), 0.05) << "trial " << trial;
    }
}

TEST(Patch, isFoundTurnedAndScaledAndInAnotherLight) {
    for (const double scale : {0.85, 1.0, 1.1}) {
        for (const double roll : {-0.4, 0.0, 0.1, 0.3}) {
            const cv::Point2f corner(0.3F, -0.2F);
            const auto seen = [&](double x, double y) { return 0.9 * waves(x, y) + 15; };
            // The corner of the reference is the center that the second image turns about.
            const Patch patch = patchAt(seen, 0.3, -0.2, {0.6F, 0.5F}, scale, roll);
            const auto offset =
                alignPatch(patchAt(waves, 0, 0, corner),
                           {static_cast<float>(scale), static_cast<float>(roll)}, patch);
            ASSERT_TRUE(offset) << "scale " << scale << ", roll " << roll;
            EXPECT_LT(cv::norm(patch.corner + *offset), 0.12)
                << "scale " << scale << ", roll " << roll;
        }
    }
}

TEST(Patch, isNotFoundWhereGrayValuesTellNoPlace) {
    const auto plain = [](double, double) { return 90.0; };
    const auto edge = [](double x, double) { return x < 0.3 ? 40.0 : 200.0; };
    const auto other = [](double x, double y) { return 255 - waves(x, y); };
    EXPECT_FALSE(alignPatch(patchAt(plain, 0, 0), {}, patchAt(plain, 0, 0)));
    EXPECT_FALSE(alignPatch(patchAt(edge, 0, 0), {}, patchAt(edge, 0, 0)));
    EXPECT_FALSE(alignPatch(patchAt(waves, 0, 0), {}, patchAt(other, 0, 0)));
}

/** Alignment moves corners away from the pixel in the center. */
TEST(Patch, isNotMadeOfPixelsBeyondItsBorder) {
    for (const float x : {-3.2F, 0.0F, 3.2F}) {
        for (const float y : {-3.2F, 3.2F}) {
            const Patch patch = patchAt(waves, 0, 0, {x, y});
            EXPECT_FALSE(alignPatch(patch, {0.87F, 0}, patch)) << x << ", " << y;
            EXPECT_FALSE(alignPatch(patch, {1, 0.1F}, patch)) << x << ", " << y;
        }
    }
}

TEST(Patch, isNotLookedForBeyondItsBorder) {
    const Patch patch = patchAt(waves, 0, 0);
    EXPECT_TRUE(alignPatch(patch, {}, patch));
    EXPECT_FALSE(alignPatch(patch, {2, 0}, patch));
    EXPECT_FALSE(alignPatch(patch, {1, std::nanf("")}, patch));
    EXPECT_FALSE(alignPatch(patch, {}, patchAt(waves, 4, 0)));
}

}  // namespace
}  // namespace rgbd_graphslam
