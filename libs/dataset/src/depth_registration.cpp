#include "rgbd_graphslam/dataset/depth_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rgbd_graphslam {

DepthRegistration::DepthRegistration(const Camera& depth, const Camera& color,
                                     const SE3& T_color_depth, double unit_m)
    : depth_(depth), color_(color), T_color_depth_(T_color_depth), unit_m_(unit_m) {
    rays_.reserve(static_cast<std::size_t>(depth.width) * depth.height);
    for (int v = 0; v < depth.height; ++v) {
        for (int u = 0; u < depth.width; ++u) {
            rays_.push_back(depth.unproject(u, v, 1));
        }
    }
}

cv::Mat DepthRegistration::operator()(const cv::Mat& depth) const {
    cv::Mat1w registered(color_.height, color_.width, std::uint16_t{0});
    const cv::Mat1w readings = depth;
    const Eigen::Vector2d color_px = color_.pixelsPerRadian(), depth_px = depth_.pixelsPerRadian();
    std::size_t ray = 0;
    for (int v = 0; v < depth_.height; ++v) {
        for (int u = 0; u < depth_.width; ++u, ++ray) {
            if (readings(v, u) == 0) continue;
            const double z = readings(v, u) * unit_m_;
            const Eigen::Vector3d point = T_color_depth_ * (z * rays_[ray]);
            if (point.z() <= 0) continue;
            const double half = 0.5 * z / point.z();
            place(point, (half * color_px).cwiseQuotient(depth_px), registered);
        }
    }
    return registered;
}

void DepthRegistration::place(const Eigen::Vector3d& point_m, const Eigen::Vector2d& reach_px,
                              cv::Mat1w& to) const {
    const double units = std::round(point_m.z() / unit_m_);
    if (units < 1 || units > std::numeric_limits<std::uint16_t>::max()) return;
    const Eigen::Vector2d center = color_.project(point_m);
    if (!(center.array().abs() < 1e6).all()) return;
    const auto reading = static_cast<std::uint16_t>(units);
    const int left = std::max(0, static_cast<int>(std::ceil(center.x() - reach_px.x())));
    const int right =
        std::min(to.cols - 1, static_cast<int>(std::floor(center.x() + reach_px.x())));
    const int top = std::max(0, static_cast<int>(std::ceil(center.y() - reach_px.y())));
    const int bottom =
        std::min(to.rows - 1, static_cast<int>(std::floor(center.y() + reach_px.y())));
    for (int v = top; v <= bottom; ++v) {
        for (int u = left; u <= right; ++u) {
            if (to(v, u) == 0 || reading < to(v, u)) to(v, u) = reading;
        }
    }
}

}  // namespace rgbd_graphslam
