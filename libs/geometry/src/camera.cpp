#include "rgbd_graphslam/geometry/camera.h"

#include <algorithm>

namespace rgbd_graphslam {
namespace {

/** On the normalized plane z = 1. */
Eigen::Vector2d distorted(const Eigen::Vector2d& n, const std::array<double, 5>& d) {
    const double x = n.x(), y = n.y(), r2 = n.squaredNorm();
    const double radial = 1 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
    return {x * radial + 2 * d[2] * x * y + d[3] * (r2 + 2 * x * x),
            y * radial + d[2] * (r2 + 2 * y * y) + 2 * d[3] * x * y};
}

}  // namespace

bool Camera::hasDistortion() const {
    return std::any_of(distortion.begin(), distortion.end(), [](double d) { return d != 0; });
}

Eigen::Vector2d Camera::distort(const Eigen::Vector2d& undistorted) const {
    const Eigen::Vector2d n((undistorted.x() - cx) / fx, (undistorted.y() - cy) / fy);
    const Eigen::Vector2d d = distorted(n, distortion);
    return {fx * d.x() + cx, fy * d.y() + cy};
}

Eigen::Vector2d Camera::undistort(const Eigen::Vector2d& seen) const {
    constexpr int iterations = 12;
    const Eigen::Vector2d target((seen.x() - cx) / fx, (seen.y() - cy) / fy);
    Eigen::Vector2d n = target;
    for (int i = 0; i < iterations; ++i) n += target - distorted(n, distortion);
    return {fx * n.x() + cx, fy * n.y() + cy};
}

bool Camera::undoesDistortion() const {
    constexpr int steps = 8;
    constexpr double most_off_px = 1;
    if (!hasDistortion()) return true;
    for (int row = 0; row <= steps; ++row) {
        for (int column = 0; column <= steps; ++column) {
            const Eigen::Vector2d seen((width - 1.0) * column / steps,
                                       (height - 1.0) * row / steps);
            const double off_px = (distort(undistort(seen)) - seen).norm();
            if (!(off_px <= most_off_px)) return false;
        }
    }
    return true;
}

}  // namespace rgbd_graphslam
