#include "smoothing.h"

#include <cstdint>
#include <vector>

#include "vector_clones.h"

namespace rgbd_graphslam {
namespace {

/** 16 times the weighted mean of five neighbors, `stride` apart: at most 16 * 16 * 255 when it is
 *  done twice, which fits. */
template <typename T>
inline std::uint16_t weigh(const T* center, int stride) {
    return center[-2 * stride] + center[2 * stride] + 4 * (center[-stride] + center[stride]) +
           6 * center[0];
}

/** Plain loops, which the compiler makes vectors of. \param sums buffer of one entry a column */
RGBD_VECTOR_CLONES
void smoothRow(const std::uint8_t* row, int step, int width, std::uint16_t* __restrict sums,
               std::uint8_t* __restrict smooth) {
    for (int x = 0; x < width; ++x) sums[x] = weigh(row + x, step);
    for (int x = smoothing_radius; x < width - smoothing_radius; ++x) {
        smooth[x] = static_cast<std::uint8_t>((weigh(sums + x, 1) + 128) >> 8);
    }
}

}  // namespace

void smooth(const cv::Mat& image, cv::Mat& smooth) {
    static thread_local std::vector<std::uint16_t> sums;
    sums.resize(image.cols);
    for (int y = smoothing_radius; y < image.rows - smoothing_radius; ++y) {
        smoothRow(image.ptr<std::uint8_t>(y), static_cast<int>(image.step), image.cols, sums.data(),
                  smooth.ptr<std::uint8_t>(y));
    }
}

}  // namespace rgbd_graphslam
