#include "rgbd_graphslam/mapping/depth_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

std::string sizeText(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

void checkImage(const RgbdImage& image, const Camera& camera) {
    const std::string name = "the frame at " + std::to_string(image.stamp_s) + " s";
    if (image.depth.type() != CV_16UC1) {
        throw Error(name + " has no 16-bit depth image", "import the sequence again");
    }
    if (image.depth.cols != camera.width || image.depth.rows != camera.height) {
        throw Error(name + " has a depth image of " + sizeText(image.depth.cols, image.depth.rows) +
                        " pixels, its camera one of " + sizeText(camera.width, camera.height),
                    "register depth to color and import again");
    }
}

cv::Mat1f meters(const cv::Mat& raw, double unit_m, double nearest_m) {
    cv::Mat1f depth(raw.size());
    const auto unit = static_cast<float>(unit_m), nearest = static_cast<float>(nearest_m);
    for (int v = 0; v < raw.rows; ++v) {
        const auto* in = raw.ptr<std::uint16_t>(v);
        float* out = depth[v];
        for (int u = 0; u < raw.cols; ++u) {
            const float z = unit * in[u];
            out[u] = z >= nearest ? z : 0.f;
        }
    }
    return depth;
}

/** A neighbor without a reading says nothing. Without a branch, for whole rows to be vectorised.
 */
bool jumps(float z, float neighbor, float tolerance) {
    return (neighbor > 0) & (std::abs(neighbor - z) > tolerance);
}

/** Drops readings beside a depth edge. */
class EdgeFilter {
  public:
    EdgeFilter(double ratio, const DepthNoise& noise)
        : ratio_(static_cast<float>(ratio)),
          a_(static_cast<float>(noise.a)),
          b_(static_cast<float>(noise.b)),
          c_(static_cast<float>(noise.c)) {}

    void cleanRow(const cv::Mat1f& depth, int v, float* out) const {
        const float *row = depth[v], *above = depth[std::max(v - 1, 0)];
        const float* below = depth[std::min(v + 1, depth.rows - 1)];
        const int last = depth.cols - 1;
        const auto clean = [&](int u, int left, int right) {
            return cleaned(row[u], row[left], row[right], above[u], below[u]);
        };
        out[0] = clean(0, 0, std::min(1, last));
        for (int u = 1; u < last; ++u) out[u] = clean(u, u - 1, u + 1);
        out[last] = clean(last, std::max(last - 1, 0), last);
    }

  private:
    float cleaned(float z, float left, float right, float above, float below) const {
        const float tolerance = ratio_ * z + 3 * (a_ + b_ * (z - c_) * (z - c_));
        const int edges = jumps(z, above, tolerance) + jumps(z, below, tolerance) +
                          jumps(z, left, tolerance) + jumps(z, right, tolerance);
        return edges > 0 ? 0.f : z;
    }

    float ratio_, a_, b_, c_;
};

cv::Mat3b colorOf(const RgbdImage& image) {
    const cv::Size size = image.depth.size();
    if (image.color.size() == size && image.color.type() == CV_8UC3) return image.color;
    cv::Mat3b color(size, cv::Vec3b(160, 160, 160));
    if (image.gray.size() == size) cv::cvtColor(image.gray, color, cv::COLOR_GRAY2BGR);
    return color;
}

}  // namespace

RayTable::RayTable(const Camera& camera) : camera_(camera), pinhole_(camera.pinhole()) {
    directions_.reserve(static_cast<std::size_t>(camera.width) * camera.height);
    for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
            directions_.push_back(camera.unproject(u, v, 1).head<2>().cast<float>());
        }
    }
    if (!camera.hasDistortion()) return;
    rectified_from_.reserve(directions_.size());
    for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
            const Eigen::Vector2d seen = camera.project(pinhole_.unproject(u, v, 1));
            const int su = static_cast<int>(std::lround(seen.x()));
            const int sv = static_cast<int>(std::lround(seen.y()));
            const bool inside = su >= 0 && sv >= 0 && su < camera.width && sv < camera.height;
            rectified_from_.push_back(inside ? sv * camera.width + su : -1);
        }
    }
}

cv::Mat1f RayTable::rectified(const cv::Mat1f& depth) const {
    if (rectified_from_.empty()) return depth;
    cv::Mat1f out(depth.size());
    const auto* in = depth.ptr<float>();
    auto* pixel = out.ptr<float>();
    for (const int from : rectified_from_) *pixel++ = from < 0 ? 0.f : in[from];
    return out;
}

cv::Mat1f cleanDepth(const RgbdImage& image, const Camera& camera, const MapOptions& options,
                     const DepthNoise& noise) {
    checkImage(image, camera);
    const cv::Mat1f depth = meters(image.depth, image.depth_unit_m, options.min_range_m);
    cv::Mat1f clean(depth.size());
    const EdgeFilter filter(options.edge_ratio, noise);
    for (int v = 0; v < depth.rows; ++v) filter.cleanRow(depth, v, clean[v]);
    return clean;
}

DepthView::DepthView(const RgbdImage& image, const RayTable& ray_table, const MapOptions& options)
    : stamp_s(image.stamp_s),
      rays(ray_table),
      depth(cleanDepth(image, ray_table.camera(), options)),
      color(colorOf(image)),
      sight(ray_table.rectified(depth)),
      max_range_m(options.max_range_m) {}

}  // namespace rgbd_graphslam
