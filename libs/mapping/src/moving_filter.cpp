#include "rgbd_graphslam/mapping/moving_filter.h"

#include <algorithm>
#include <cmath>

namespace rgbd_graphslam {
namespace {

/** A keyframe is compared with so many: more tell hardly more. */
constexpr std::size_t most_compared = 40;

std::vector<int> blocksOfPixels(const PixelBlocks& blocks, const Camera& camera) {
    const Camera pinhole = camera.pinhole();
    std::vector<int> result;
    result.reserve(static_cast<std::size_t>(camera.width) * camera.height);
    for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
            const Eigen::Vector2d pixel = camera.hasDistortion()
                                              ? pinhole.project(camera.unproject(u, v, 1))
                                              : Eigen::Vector2d(u, v);
            // The border of a fisheye's image lies far outside of, or behind, its pinhole's.
            const bool is_near = pixel.allFinite() && pixel.cwiseAbs().maxCoeff() < 1e6;
            result.push_back(is_near ? blocks.blockAt(pixel.x(), pixel.y()) : -1);
        }
    }
    return result;
}

/** Decides pixel by pixel along the border of a mask of blocks. */
class MaskBorder {
  public:
    MaskBorder(const MovingBlocks& moving, const std::vector<float>& depth,
               const std::vector<std::uint8_t>& mask)
        : moving_(moving), depth_(depth), mask_(mask), near_(mask.size()) {
        const Camera& camera = moving.camera();
        for (int v = 0; v < camera.height; ++v)
            for (int u = 0; u < camera.width; ++u)
                if (mask[v * camera.width + u]) markAround(u, v);
    }

    /** Whether a reading in a block is of what moves. A block stands for its nearest surface: its
     *  other readings, and those of blocks without depth, follow the blocks next to them. */
    bool moves(int block, float z) const {
        if (!near_[block]) return false;
        const bool is_the_blocks = agree(depth_[block], z);
        if (is_the_blocks) return mask_[block];
        bool beside = false;
        forEachAround(block % moving_.camera().width, block / moving_.camera().width,
                      [&](int other) { beside |= mask_[other] && agree(depth_[other], z); });
        return beside;
    }

  private:
    bool agree(float a, float b) const {
        return a > 0 && std::abs(a - b) <= moving_.step(std::min(a, b));
    }
    void markAround(int u, int v) {
        forEachAround(u, v, [&](int block) { near_[block] = 1; });
    }
    template <class Visit>
    void forEachAround(int u, int v, const Visit& visit) const {
        const Camera& camera = moving_.camera();
        for (int y = std::max(v - 1, 0); y <= std::min(v + 1, camera.height - 1); ++y)
            for (int x = std::max(u - 1, 0); x <= std::min(u + 1, camera.width - 1); ++x)
                visit(y * camera.width + x);
    }

    const MovingBlocks& moving_;
    const std::vector<float>& depth_;
    const std::vector<std::uint8_t>& mask_;
    std::vector<std::uint8_t> near_;  // blocks in or beside the mask
};

}  // namespace

MovingFilter::MovingFilter(const Camera& camera)
    : blocks_(camera),
      moving_(blocks_.camera(), {}),
      block_of_pixel_(blocksOfPixels(blocks_, camera)) {}

bool MovingFilter::fits(const RgbdImage& image) const {
    return image.depth.type() == CV_16UC1 && image.depth.isContinuous() &&
           image.depth.total() == block_of_pixel_.size();
}

void MovingFilter::add(const RgbdImage& image, double stamp_s, const SE3& T_world_cam,
                       int session) {
    if (!fits(image)) return;
    sights_.push_back({stamp_s, T_world_cam, blocks_.depthOf(image), session});
}

RgbdImage MovingFilter::withoutMovers(const RgbdImage& image, double stamp_s,
                                      const SE3& T_world_cam, int session) const {
    if (!fits(image)) return image;
    const Sight sight{stamp_s, T_world_cam, blocks_.depthOf(image), session};
    std::vector<const Sight*> all;
    for (const Sight& other : sights_) all.push_back(&other);
    const auto mask = moving_.find(sight, moving_.overlapping(sight, all, most_compared));
    if (std::none_of(mask.begin(), mask.end(), [](int moves) { return moves; })) return image;
    const MaskBorder border(moving_, sight.depth_m, mask);
    RgbdImage result = image;
    result.depth = image.depth.clone();
    const auto unit = static_cast<float>(image.depth_unit_m);
    auto* reading = result.depth.ptr<std::uint16_t>();
    for (const int block : block_of_pixel_) {
        if (block >= 0 && *reading && border.moves(block, unit * *reading)) *reading = 0;
        ++reading;
    }
    return result;
}

Trajectory sightsOf(const MapInputs& inputs) {
    constexpr double least_interval_s = 0.1, most = 3000;
    if (inputs.trajectory.empty()) return inputs.keyframes;
    const double span_s = inputs.trajectory.back().stamp_s - inputs.trajectory.front().stamp_s;
    const double interval_s = std::max(least_interval_s, span_s / most);
    Trajectory sights;
    for (const StampedPose& pose : inputs.trajectory) {
        // Stamps that jitter must not leave out every other frame.
        const bool due = sights.empty() || pose.stamp_s - sights.back().stamp_s > 0.9 * interval_s;
        if (due) sights.push_back(pose);
    }
    return sights;
}

}  // namespace rgbd_graphslam
