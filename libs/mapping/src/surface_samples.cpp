#include "rgbd_graphslam/mapping/surface_samples.h"

#include <algorithm>

namespace rgbd_graphslam {
namespace {

/** Length of the longest ray for z = 1. */
double widest(const Camera& camera) {
    const Eigen::Vector2d first = camera.toPlane({0, 0});
    const Eigen::Vector2d last = camera.toPlane({camera.width, camera.height});
    const Eigen::Vector2d reach = (-first).cwiseMax(last);
    return Eigen::Vector3d(reach.x(), reach.y(), 1).norm();
}

}  // namespace

SurfaceSampler::SurfaceSampler(const DepthView& view, const SE3& T_world_cam, double voxel_m,
                               int step)
    : view_(view), step_(step), max_range_(static_cast<float>(view.max_range_m)) {
    constexpr double spare = 1.5;  // lens distortion can widen the view
    const double reach = std::ceil(spare * widest(view.rays.camera()) * view.max_range_m / voxel_m);
    const Eigen::Vector3d base = (T_world_cam.t / voxel_m).array().floor() - reach;
    base_voxel_ = base.cast<int>();
    R_ = (T_world_cam.R / voxel_m).cast<float>();
    t_ = (T_world_cam.t / voxel_m - base).cast<float>();
}

}  // namespace rgbd_graphslam
