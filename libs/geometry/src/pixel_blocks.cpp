#include "rgbd_graphslam/geometry/pixel_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rgbd_graphslam {
namespace {

constexpr int small_columns = 80;
/** Readings this much farther than the nearest of a block belong to another surface. */
constexpr double same_surface = 1.05;

/** Mean of the nearest surface in the block, in units of the image; 0 when half of it is blind. */
float nearestDepth(const cv::Mat& depth, int x, int y, int block) {
    int nearest = 65536, seen = 0;
    for (int j = y; j < y + block; ++j) {
        const auto* row = depth.ptr<std::uint16_t>(j);
        for (int i = x; i < x + block; ++i) {
            if (row[i] == 0) continue;
            ++seen;
            nearest = std::min<int>(nearest, row[i]);
        }
    }
    if (2 * seen < block * block) return 0;
    const int farthest = static_cast<int>(same_surface * nearest);
    std::int64_t sum = 0, count = 0;
    for (int j = y; j < y + block; ++j) {
        const auto* row = depth.ptr<std::uint16_t>(j);
        for (int i = x; i < x + block; ++i) {
            if (row[i] == 0 || row[i] > farthest) continue;
            sum += row[i];
            ++count;
        }
    }
    return static_cast<float>(sum) / static_cast<float>(count);
}

}  // namespace

PixelBlocks::PixelBlocks(const Camera& camera)
    : block_px_(std::max(1, camera.width / small_columns)),
      small_(camera.pinhole().shrunk(block_px_)) {
    const Camera pinhole = camera.pinhole();
    for (int y = 0; y < small_.height; ++y) {
        for (int x = 0; x < small_.width; ++x) {
            const Eigen::Vector2d center(x * block_px_ + 0.5 * (block_px_ - 1),
                                         y * block_px_ + 0.5 * (block_px_ - 1));
            const Eigen::Vector2d seen =
                camera.hasDistortion()
                    ? camera.project(pinhole.unproject(center.x(), center.y(), 1))
                    : center;
            const auto corner = [&](double c, int size) {
                const double first = std::lround(c - 0.5 * (block_px_ - 1));
                return static_cast<int>(std::clamp<double>(first, 0, size - block_px_));
            };
            columns_.push_back(corner(seen.x(), camera.width));
            rows_.push_back(corner(seen.y(), camera.height));
        }
    }
}

std::vector<float> PixelBlocks::depthOf(const RgbdImage& image) const {
    std::vector<float> depth(count());
    const auto unit = static_cast<float>(image.depth_unit_m);
    for (std::size_t i = 0; i < depth.size(); ++i) {
        depth[i] = unit * nearestDepth(image.depth, columns_[i], rows_[i], block_px_);
    }
    return depth;
}

int PixelBlocks::blockAt(double u, double v) const {
    const int x = static_cast<int>(std::floor((u + 0.5) / block_px_));
    const int y = static_cast<int>(std::floor((v + 0.5) / block_px_));
    const bool inside = x >= 0 && y >= 0 && x < small_.width && y < small_.height;
    return inside ? y * small_.width + x : -1;
}

}  // namespace rgbd_graphslam
