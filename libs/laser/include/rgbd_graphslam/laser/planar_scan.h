/** Laser scans as points in the robot's plane. */
#pragma once
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "rgbd_graphslam/estimation/wheel_preintegration.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

inline Eigen::Vector2d rotated(double yaw, const Eigen::Vector2d& p) {
    const double c = std::cos(yaw), s = std::sin(yaw);
    return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}

inline Eigen::Vector2d positionOf(const PlanarPose& pose) {
    return {pose.x, pose.y};
}

/** Coordinates of a point given in the frame of `pose`. */
inline Eigen::Vector2d transformed(const PlanarPose& pose, const Eigen::Vector2d& p) {
    return rotated(pose.yaw, p) + positionOf(pose);
}

/** In the plane z = 0, level. */
SE3 toSE3(const PlanarPose& pose);

/** Angle in (-pi, pi]. */
inline double wrapped(double angle_rad) {
    return std::remainder(angle_rad, 2 * M_PI);
}

/** Where a beam ended. */
struct ScanPoint {
    Eigen::Vector2d p = Eigen::Vector2d::Zero();  // m
    /** Unit normal of the surface, toward the scanner; zero where it is not known. */
    Eigen::Vector2d normal = Eigen::Vector2d::Zero();

    bool hasNormal() const { return !normal.isZero(); }
};

/** Points of one scan in the frame of the robot's base. */
struct PlanarScan {
    double stamp_s = 0;
    /** Where the scanner sits. */
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();
    std::vector<ScanPoint> points;
};

/** Projects a scan into the plane of the robot's base, as its `sensorPose` says, and fits a normal
 *  to the neighbors of each point. Readings outside the range (m), at the scanner's own maximum or
 *  marked as invalid are left out. */
PlanarScan toPlanarScan(const mrpt::obs::CObservation2DRangeScan& scan, double min_range_m,
                        double max_range_m);

/** What makes the scans of a scanner useless for a plan: one line, or empty. \param scan any one */
std::string mountingProblem(const mrpt::obs::CObservation2DRangeScan& scan);

}  // namespace rgbd_graphslam
