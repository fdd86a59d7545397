#include "rgbd_graphslam/viewer/picking.h"

#include <algorithm>
#include <limits>

namespace rgbd_graphslam {

std::optional<std::size_t> keyframeAt(const Trajectory& keyframes, std::size_t count,
                                      const Eigen::Vector2d& pixel, const OrbitCamera& camera,
                                      const Eigen::Vector2i& size_px, double radius_px) {
    std::optional<std::size_t> best;
    double best_px = radius_px;
    for (std::size_t k = 0; k < std::min(count, keyframes.size()); ++k) {
        const Eigen::Vector3d seen = camera.project(keyframes[k].T_world_cam.t, size_px);
        const double distance_px = (seen.head<2>() - pixel).norm();
        if (seen.z() <= 0 || distance_px > best_px) continue;
        best_px = distance_px;
        best = k;
    }
    return best;
}

std::optional<Eigen::Vector3d> surfaceAt(const cv::Mat1f& depths, const Eigen::Vector2i& pixel,
                                         const OrbitCamera& camera,
                                         const Eigen::Vector2i& size_px) {
    const Eigen::Vector2i center(depths.cols / 2, depths.rows / 2);
    std::optional<Eigen::Vector3d> nearest;
    int nearest_squared = std::numeric_limits<int>::max();
    for (int y = 0; y < depths.rows; ++y) {
        for (int x = 0; x < depths.cols; ++x) {
            const Eigen::Vector2i offset = Eigen::Vector2i(x, y) - center;
            if (depths(y, x) >= 1 || offset.squaredNorm() >= nearest_squared) continue;
            nearest_squared = offset.squaredNorm();
            const Eigen::Vector2d middle = (pixel + offset).cast<double>().array() + 0.5;
            nearest = camera.unproject(middle, depths(y, x), size_px);
        }
    }
    return nearest;
}

}  // namespace rgbd_graphslam
