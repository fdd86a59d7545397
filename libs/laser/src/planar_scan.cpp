#include "rgbd_graphslam/laser/planar_scan.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace {

using mrpt::obs::CObservation2DRangeScan;

constexpr int neighbors_each_side = 10;
constexpr double most_tilted_rad = 0.17;

double beamStep(const CObservation2DRangeScan& scan) {
    const auto beams = static_cast<double>(scan.getScanSize());
    const double step = beams > 1 ? scan.aperture / (beams - 1) : 0;
    return scan.rightToLeft ? step : -step;
}

/** Ends of the beams in the robot's plane; nothing where there is no reading. */
std::vector<std::optional<Eigen::Vector2d>> endsOf(const CObservation2DRangeScan& scan,
                                                   double min_range_m, double max_range_m) {
    const SE3 T_base_laser = toSE3(mrpt::poses::CPose3D(scan.sensorPose));
    const double farthest = std::min<double>(max_range_m, 0.995 * scan.maxRange);
    const double step = beamStep(scan), first = -0.5 * step * (scan.getScanSize() - 1.0);
    std::vector<std::optional<Eigen::Vector2d>> ends(scan.getScanSize());
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const double range = scan.getScanRange(i), angle = first + step * static_cast<double>(i);
        const bool valid = scan.getScanRangeValidity(i) && std::isfinite(range) &&
                           range >= min_range_m && range <= farthest;
        if (!valid) continue;
        const Eigen::Vector3d end(range * std::cos(angle), range * std::sin(angle), 0);
        ends[i] = (T_base_laser * end).head<2>();
    }
    return ends;
}

/** Zero where the neighbors do not lie on a line. */
Eigen::Vector2d normalOf(const std::vector<Eigen::Vector2d>& neighbors,
                         const Eigen::Vector2d& to_scanner) {
    constexpr double least_points = 3, widest_share = 0.05;
    if (static_cast<double>(neighbors.size()) < least_points) return Eigen::Vector2d::Zero();
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& p : neighbors) mean += p / static_cast<double>(neighbors.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const auto& p : neighbors) spread += (p - mean) * (p - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    if (axes.eigenvalues()(0) > widest_share * axes.eigenvalues()(1))
        return Eigen::Vector2d::Zero();
    const Eigen::Vector2d normal = axes.eigenvectors().col(0).normalized();
    return normal.dot(to_scanner) < 0 ? Eigen::Vector2d(-normal) : normal;
}

std::vector<Eigen::Vector2d> neighborsOf(const std::vector<std::optional<Eigen::Vector2d>>& ends,
                                         int i, double reach_m) {
    std::vector<Eigen::Vector2d> neighbors;
    const int last = static_cast<int>(ends.size()) - 1;
    for (int j = std::max(0, i - neighbors_each_side); j <= std::min(last, i + neighbors_each_side);
         ++j) {
        if (ends[j] && (*ends[j] - *ends[i]).norm() <= reach_m) neighbors.push_back(*ends[j]);
    }
    return neighbors;
}

}  // namespace

SE3 toSE3(const PlanarPose& pose) {
    return {rotationExp({0, 0, pose.yaw}), Eigen::Vector3d(pose.x, pose.y, 0)};
}

PlanarScan toPlanarScan(const CObservation2DRangeScan& scan, double min_range_m,
                        double max_range_m) {
    constexpr double least_reach_m = 0.2, steps_of_reach = 3;
    PlanarScan planar;
    planar.stamp_s = toSeconds(scan.timestamp);
    planar.origin = {scan.sensorPose.x(), scan.sensorPose.y()};
    const auto ends = endsOf(scan, min_range_m, max_range_m);
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (!ends[i]) continue;
        const Eigen::Vector2d to_scanner = planar.origin - *ends[i];
        const double spacing_m = std::abs(beamStep(scan)) * to_scanner.norm();
        const double reach_m = std::max(least_reach_m, steps_of_reach * spacing_m);
        planar.points.push_back(
            {*ends[i], normalOf(neighborsOf(ends, static_cast<int>(i), reach_m), to_scanner)});
    }
    return planar;
}

std::string mountingProblem(const CObservation2DRangeScan& scan) {
    const SE3 T_base_laser = toSE3(mrpt::poses::CPose3D(scan.sensorPose));
    const double tilt_rad = std::acos(std::min(1.0, std::abs(T_base_laser.R(2, 2))));
    if (tilt_rad > most_tilted_rad) {
        return formatted("the laser '%s' is tilted by %.0f degrees according to its sensorPose",
                         scan.sensorLabel.c_str(), tilt_rad * 180 / M_PI);
    }
    if (!T_base_laser.t.allFinite() || T_base_laser.t.norm() > 20) {
        return formatted("the sensorPose of the laser '%s' is (%g, %g, %g) m, off any robot",
                         scan.sensorLabel.c_str(), T_base_laser.t.x(), T_base_laser.t.y(),
                         T_base_laser.t.z());
    }
    return {};
}

}  // namespace rgbd_graphslam
