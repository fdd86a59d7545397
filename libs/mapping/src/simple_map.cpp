#include "rgbd_graphslam/mapping/simple_map.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <vector>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/mapping/level_scan.h"
#include "rgbd_graphslam/mapping/surface_samples.h"

namespace rgbd_graphslam {
namespace {

constexpr double pose_sigma_m = 0.02, pose_sigma_rad = 0.01;

/** Mean positions of the readings of each voxel of octree_resolution_m, in the frame a. */
std::vector<Eigen::Vector3f> thinnedPoints(const DepthView& view, const SE3& T_a_cam,
                                           const MapOptions& options) {
    const double voxel_m = options.octree_resolution_m;
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

void addKeyframe(mrpt::maps::CSimpleMap& map, double stamp_s, const SE3& T_up_cam,
                 const DepthView& view, const MapOptions& options) {
    const SE3 T_up_base = basePose(T_up_cam);
    const SE3 T_base_cam = T_up_base.inverse() * T_up_cam;
    const auto points = thinnedPoints(view, T_base_cam, options);
    const auto cloud =
        cloudObservation(points, T_base_cam * T_optical_from_mrpt, options.max_range_m);
    const auto scan = levelScan(view, T_base_cam, options);
    cloud->timestamp = scan->timestamp = toMrptTime(stamp_s);
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(cloud);
    frame->insert(scan);
    map.insert(gaussian(T_up_base), frame);
}

}  // namespace rgbd_graphslam
