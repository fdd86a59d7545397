#include "scan_layer.h"

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/laser/scan_grid.h"

namespace rgbd_graphslam {
namespace {

constexpr double longest_gap_s = 0.3, moved_m = 0.1, turned_rad = 0.09;
constexpr double farthest_m = 30;

/** Nothing where no beam ends at the height of an obstacle. */
std::optional<ScanBeams> beamsOf(const mrpt::obs::CObservation2DRangeScan& scan,
                                 const SE3& T_up_laser, const MapOptions& options) {
    ScanBeams beams;
    beams.origin = T_up_laser.t.head<2>();
    const auto count = static_cast<double>(scan.getScanSize());
    const double step = (scan.rightToLeft ? 1 : -1) * scan.aperture / std::max(1.0, count - 1);
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
        const double range = scan.getScanRange(i);
        const bool valid = scan.getScanRangeValidity(i) && range > 0.05 &&
                           range < std::min<double>(farthest_m, 0.995 * scan.maxRange);
        if (!valid) continue;
        const double angle = step * (static_cast<double>(i) - 0.5 * (count - 1));
        const Eigen::Vector3d end =
            T_up_laser * (range * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
        if (end.z() < options.z_min_m || end.z() > options.z_max_m) continue;
        beams.ends.push_back(end.head<2>());
    }
    if (beams.ends.empty()) return std::nullopt;
    return beams;
}

}  // namespace

SE3 ScanLayer::Scan::T_up_laser() const {
    return T_up_cam * T_base_cam->inverse() * toSE3(mrpt::poses::CPose3D(observation->sensorPose));
}

void ScanLayer::note(const mrpt::obs::CObservation& entry, const Trajectory& trajectory) {
    if (!dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&entry)) return;
    const auto pose = poseAt(trajectory, toSeconds(entry.timestamp), longest_gap_s);
    if (!pose) return;
    for (auto last = scans_.rbegin(); last != scans_.rend(); ++last) {
        if (last->observation->sensorLabel != entry.sensorLabel) continue;
        const SE3 moved = last->T_up_cam.inverse() * *pose;
        if (moved.t.norm() < moved_m && moved.angle() < turned_rad) return;
        break;
    }
    const auto copy = std::make_shared<mrpt::obs::CObservation2DRangeScan>(
        dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(entry));
    scans_.push_back({copy, *pose});
}

void ScanLayer::place(const SE3& T_base_cam) {
    for (Scan& scan : scans_) {
        if (!scan.T_base_cam) scan.T_base_cam = T_base_cam;
    }
}

std::size_t ScanLayer::mergeInto(mrpt::maps::COccupancyGridMap2D& grid,
                                 const MapOptions& options) const {
    std::size_t entered = 0;
    if (scans_.empty()) return entered;
    ScanGrid beams(grid.getResolution());
    for (const Scan& scan : scans_) {
        if (!scan.T_base_cam) continue;
        const auto inserted = beamsOf(*scan.observation, scan.T_up_laser(), options);
        if (!inserted) continue;
        beams.insert(*inserted);
        ++entered;
    }
    if (beams.empty()) {
        const Scan& first = scans_.front();
        sayWarning(formatted(
            "no scan of the laser '%s' meets anything between z_min_m = %g and z_max_m = %g m "
            "(sensorPose puts it at z = %.2f m in the map): the grid is made without it",
            first.observation->sensorLabel.c_str(), options.z_min_m, options.z_max_m,
            first.T_base_cam ? first.T_up_laser().t.z() : 0.0));
        return entered;
    }
    beams.mergeInto(grid, options.memory_limit_mb);
    return entered;
}

}  // namespace rgbd_graphslam
