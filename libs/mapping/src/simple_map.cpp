#include "rgbd_graphslam/mapping/simple_map.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cmath>
#include <vector>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/mapping/surface_samples.h"

namespace rgbd_graphslam {
namespace {

constexpr int rays = 361;
constexpr double pose_sigma_m = 0.02, pose_sigma_rad = 0.01;

/** Mean positions of the readings of each voxel, in the frame a. */
std::vector<Eigen::Vector3f> thinned(const DepthView& view, const SE3& T_a_cam, double voxel_m) {
    VoxelTable<SurfaceSample> voxels;
    SurfaceSampler(view, T_a_cam, voxel_m)
        .forEachRun([&](const VoxelIndex& voxel, const SurfaceSample& run) {
            voxels[voxelKey(voxel)].add(run);
        });
    std::vector<Eigen::Vector3f> points;
    points.reserve(voxels.entries().size());
    for (const auto& [key, sum] : voxels.entries()) {
        const VoxelIndex v = voxelOfKey(key);
        points.push_back(static_cast<float>(voxel_m) *
                         (Eigen::Vector3f(v.x, v.y, v.z) + sum.offset / sum.weight));
    }
    return points;
}

/** MRPT 2.5's point maps forget the robot's pose when they insert a CObservationPointCloud, so the
 *  points travel in the observation of a depth camera. */
mrpt::obs::CObservation3DRangeScan::Ptr cloudObservation(const std::vector<Eigen::Vector3f>& points,
                                                         const SE3& T_base_sensor,
                                                         double max_range_m) {
    const SE3 T_sensor_base = T_base_sensor.inverse();
    auto observation = mrpt::obs::CObservation3DRangeScan::Create();
    observation->sensorLabel = "DEPTH_POINTS";
    observation->sensorPose = toCPose3D(T_base_sensor);
    observation->maxRange = static_cast<float>(max_range_m);
    observation->hasPoints3D = true;
    observation->resizePoints3DVectors(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3f p = (T_sensor_base * points[i].cast<double>()).cast<float>();
        observation->points3D_x[i] = p.x();
        observation->points3D_y[i] = p.y();
        observation->points3D_z[i] = p.z();
    }
    return observation;
}

mrpt::obs::CObservation2DRangeScan::Ptr scanObservation(const std::vector<Eigen::Vector3f>& points,
                                                        const Camera& camera,
                                                        const MapOptions& options) {
    auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->sensorLabel = "DEPTH_SCAN";
    scan->aperture = static_cast<float>(2 * std::atan(0.5 * camera.width / camera.fx));
    scan->maxRange = static_cast<float>(options.max_range_m);
    scan->sensorPose =
        mrpt::poses::CPose3D(0, 0, 0.5 * (options.z_min_m + options.z_max_m), 0, 0, 0);
    scan->resizeScanAndAssign(rays, scan->maxRange, false);
    for (const auto& p : points) {
        if (p.z() < options.z_min_m || p.z() > options.z_max_m) continue;
        const float share = std::atan2(p.y(), p.x()) / scan->aperture + 0.5f;
        const int ray = static_cast<int>(std::lround(share * (rays - 1)));
        const float range = std::hypot(p.x(), p.y());
        if (ray < 0 || ray >= rays || range >= scan->getScanRange(ray)) continue;
        scan->setScanRange(ray, range);
        scan->setScanRangeValidity(ray, true);
    }
    return scan;
}

mrpt::poses::CPose3DPDFGaussian::Ptr gaussian(const SE3& T) {
    auto pdf = mrpt::poses::CPose3DPDFGaussian::Create();
    pdf->mean = toCPose3D(T);
    for (int i = 0; i < 6; ++i) {
        const double sigma = i < 3 ? pose_sigma_m : pose_sigma_rad;
        pdf->cov(i, i) = sigma * sigma;
    }
    return pdf;
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

void addKeyframe(mrpt::maps::CSimpleMap& map, double stamp_s, const SE3& T_up_cam,
                 const DepthView& view, const MapOptions& options) {
    const SE3 T_up_base = basePose(T_up_cam);
    const SE3 T_base_cam = T_up_base.inverse() * T_up_cam;
    const auto points = thinned(view, T_base_cam, options.octree_resolution_m);
    const auto cloud =
        cloudObservation(points, T_base_cam * T_optical_from_mrpt, options.max_range_m);
    const auto scan = scanObservation(points, view.rays.camera(), options);
    cloud->timestamp = scan->timestamp = toMrptTime(stamp_s);
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(cloud);
    frame->insert(scan);
    map.insert(gaussian(T_up_base), frame);
}

}  // namespace rgbd_graphslam
