#include "rgbd_graphslam/mapping/level_scan.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/mapping/surface_samples.h"

namespace rgbd_graphslam {
namespace {

constexpr double fine_m = 0.01;      // readings this near to each other are taken as one
constexpr float surface_sigmas = 5;  // how thick noise makes a surface
constexpr int enough_readings = 3;   // fewer are no surface

struct Readings {
    float range_m = 0;
    int count = 0;
};

/** Two columns of pixels for each, so that none is without. */
int raysOf(const Camera& camera) {
    return camera.width / 2 + 1;
}

float apertureOf(const Camera& camera) {
    return static_cast<float>(camera.fieldOfView());
}

/** Obstacles in each direction, from right to left. */
std::vector<std::vector<Readings>> obstacles(const DepthView& view, const SE3& T_base_cam,
                                             const MapOptions& options) {
    const int rays = raysOf(view.rays.camera());
    std::vector<std::vector<Readings>> of_ray(rays);
    const float aperture = apertureOf(view.rays.camera());
    SurfaceSampler(view, T_base_cam, fine_m)
        .forEachRun([&](const VoxelIndex& voxel, const SurfaceSample& run) {
            const Eigen::Vector3f p =
                static_cast<float>(fine_m) *
                (Eigen::Vector3f(voxel.x, voxel.y, voxel.z) + run.offset / run.weight);
            if (p.z() < options.z_min_m || p.z() > options.z_max_m) return;
            const float share = std::atan2(p.y(), p.x()) / aperture + 0.5f;
            const auto ray = std::lround(share * (rays - 1));
            if (ray >= 0 && ray < rays)
                of_ray[ray].push_back({std::hypot(p.x(), p.y()), run.readings});
        });
    return of_ray;
}

/** Mean of the nearest readings that one surface can explain: the very nearest of many errs by
 *  three sigmas. */
std::optional<float> nearestSurface(std::vector<Readings> all, const DepthNoise& noise) {
    std::sort(all.begin(), all.end(),
              [](const Readings& a, const Readings& b) { return a.range_m < b.range_m; });
    for (auto first = all.begin(); first != all.end(); ++first) {
        const float end_m =
            first->range_m + surface_sigmas * static_cast<float>(noise.sigma(first->range_m));
        Readings surface;
        for (auto at = first; at != all.end() && at->range_m <= end_m; ++at) {
            surface.range_m += static_cast<float>(at->count) * at->range_m;
            surface.count += at->count;
        }
        if (surface.count >= enough_readings)
            return surface.range_m / static_cast<float>(surface.count);
    }
    return std::nullopt;
}

}  // namespace

SE3 basePose(const SE3& T_up_cam) {
    // A camera that looks straight down or up has its heading in the direction of its image's top.
    const Eigen::Vector3d forward = T_up_cam.R.col(2), top = -T_up_cam.R.col(1);
    const bool steep = forward.head<2>().norm() < 0.1;
    const Eigen::Vector3d heading =
        steep ? Eigen::Vector3d(top * (forward.z() < 0 ? 1 : -1)) : forward;
    const double yaw = std::atan2(heading.y(), heading.x());
    return {rotationExp({0, 0, yaw}), {T_up_cam.t.x(), T_up_cam.t.y(), 0}};
}

mrpt::obs::CObservation2DRangeScan::Ptr levelScan(const DepthView& view, const SE3& T_base_cam,
                                                  const MapOptions& options) {
    auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->sensorLabel = "DEPTH_SCAN";
    scan->aperture = apertureOf(view.rays.camera());
    scan->maxRange = static_cast<float>(options.max_range_m);
    scan->sensorPose =
        mrpt::poses::CPose3D(0, 0, 0.5 * (options.z_min_m + options.z_max_m), 0, 0, 0);
    const int rays = raysOf(view.rays.camera());
    scan->resizeScanAndAssign(rays, scan->maxRange, false);
    const auto of_ray = obstacles(view, T_base_cam, options);
    for (int ray = 0; ray < rays; ++ray) {
        const auto range = nearestSurface(of_ray[ray], view.noise);
        if (!range || *range >= scan->maxRange) continue;
        scan->setScanRange(ray, *range);
        scan->setScanRangeValidity(ray, true);
    }
    return scan;
}

}  // namespace rgbd_graphslam
