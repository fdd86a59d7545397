#include "patch_orientation.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "orb_pattern.h"
#include "vector_clones.h"

namespace rgbd_graphslam {
namespace {

constexpr int lanes = 32;
constexpr int half_lanes = lanes / 2;  // that many 16-bit sums fill a register
constexpr int rows = 2 * orb_patch_radius + 1;
constexpr int left = orb_patch_radius + 1;  // lane of the center column
static_assert(rows < lanes, "a row of the disc fits into one register");

typedef std::uint8_t HalfBytes __attribute__((vector_size(half_lanes)));
typedef std::int16_t Shorts __attribute__((vector_size(lanes)));

/** All bits set in the lanes that lie in the disc, one entry a row. */
std::array<std::array<std::uint8_t, lanes>, rows> discMasks() {
    std::array<std::array<std::uint8_t, lanes>, rows> masks{};
    for (int r = 0; r < rows; ++r) {
        const int y = r - orb_patch_radius;
        const double half = std::sqrt(orb_patch_radius * orb_patch_radius - y * y + 0.5);
        for (int lane = 0; lane < lanes; ++lane) {
            masks[r][lane] = std::abs(lane - left) <= half ? 0xff : 0;
        }
    }
    return masks;
}

struct Moments {
    int x = 0, y = 0;
};

/** Sums by column first: 31 rows of bytes, even weighted by the row, fit into 16 bits. */
RGBD_VECTOR_CLONES
Moments momentsOf(const std::uint8_t* top_left, int step,
                  const std::array<std::array<std::uint8_t, lanes>, rows>& masks) {
    Shorts column_sum[2]{}, weighted[2]{};
    for (int r = 0; r < rows; ++r) {
        for (int half = 0; half < 2; ++half) {
            HalfBytes gray, mask;
            std::memcpy(&gray, top_left + r * step + half * half_lanes, half_lanes);
            std::memcpy(&mask, masks[r].data() + half * half_lanes, half_lanes);
            const Shorts wide = __builtin_convertvector(gray & mask, Shorts);
            column_sum[half] += wide;
            weighted[half] += wide * static_cast<std::int16_t>(r - orb_patch_radius);
        }
    }
    std::array<std::int16_t, lanes> sum, weight;
    std::memcpy(sum.data(), column_sum, sizeof(column_sum));
    std::memcpy(weight.data(), weighted, sizeof(weighted));
    Moments moments;
    for (int lane = 0; lane < lanes; ++lane) {
        moments.x += (lane - left) * sum[lane];
        moments.y += weight[lane];
    }
    return moments;
}

}  // namespace

float patchOrientation(const cv::Mat& image, int x, int y) {
    static const auto masks = discMasks();
    const std::uint8_t* top_left = image.ptr<std::uint8_t>(y - orb_patch_radius) + x - left;
    const Moments moments = momentsOf(top_left, static_cast<int>(image.step), masks);
    return std::atan2(static_cast<float>(moments.y), static_cast<float>(moments.x));
}

}  // namespace rgbd_graphslam
