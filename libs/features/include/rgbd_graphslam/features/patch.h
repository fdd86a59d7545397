/** What the surroundings of a corner look like, to find its place in another image exactly. */
#pragma once
#include <array>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <optional>

namespace rgbd_graphslam {

/** Gray values around a corner on its pyramid level. */
struct Patch {
    static constexpr int side = 16;  // px
    /** Row and column of the corner's pixel. */
    static constexpr int center = side / 2;

    std::array<std::uint8_t, side * side> gray{};
    /** Place of the corner relative to the center of its pixel, px. */
    cv::Point2f corner{0, 0};
};

/** How a patch turns and shrinks from one image to another. */
struct PatchMotion {
    /** Pixels of the first patch that one pixel of the second covers. */
    float scale = 1;
    /** From the first image to the second, clockwise as seen. */
    float roll_rad = 0;
};

/** Places the corner of `reference` in `patch` by least squares over gray values, whose mean may
 *  differ: Lucas and Kanade's alignment in the inverse compositional form (Baker and Matthews,
 *  "Lucas-Kanade 20 years on", IJCV 2004).
 *  \param motion from `reference` to `patch`
 *  \return offset from the corner of `patch`, px of its level; nothing when the motion is too large
 *          for the patch, gray values do not tell the place, or the two do not look alike */
std::optional<cv::Point2f> alignPatch(const Patch& reference, const PatchMotion& motion,
                                      const Patch& patch);

}  // namespace rgbd_graphslam
