/** Wheels, gyroscope and GPS in one estimate. */
#pragma once
#include <optional>
#include <vector>

#include "rgbd_graphslam/estimation/imu_preintegration.h"
#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/estimation/wheel_preintegration.h"
#include "rgbd_graphslam/fusion/gps_options.h"
#include "rgbd_graphslam/geometry/geodetic.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** A position by GPS. */
struct GpsFix {
    double stamp_s = 0;
    GeodeticPlace place;
    /** Standard deviations east, north and up, m. */
    Eigen::Vector3d sigma_m = Eigen::Vector3d::Constant(2);
};

/** Readings by rising stamp; IMU in the axes of the robot's base. */
struct GpsFusionInput {
    std::vector<WheelSample> wheels;
    std::vector<ImuSample> imu;
    std::vector<GpsFix> fixes;
    /** The antenna on the robot, m. */
    Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();
};

/** Distance of fixes to the estimate. */
struct FixResiduals {
    std::size_t fixes = 0, outliers = 0;
    /** Root mean squares over all of them: east and north together (m), and per axis over the
     *  standard deviation, whose expectation is 1. */
    double horizontal_rms_m = 0, whitened_rms = 0;
    /** What the sensor claims: root mean square of its horizontal standard deviations, m. */
    double claimed_rms_m = 0;
    /** Mean of Cauchy's cost of the squared whitened residuals. */
    double robust_cost = 0;
};

/** A robot's way on the earth. */
struct GpsFusionResult {
    /** East, north and up of the first fix; poses of the robot's base. */
    LocalTangentPlane plane{GeodeticPlace{}};
    Trajectory keyframes, trajectory;
    /** Motions measured between keyframes that follow each other. */
    std::vector<PoseEdge> edges;
    double gyro_bias_rad_s = 0;
    /** By which the wheels' ways were multiplied to fit the fixes. */
    double wheel_scale = 1;
    /** See GpsOptions: as given, or as it was chosen. */
    double wheel_slip_share = 0;
    /** Why the gyroscope was left out; empty when it was used or there is none. */
    std::string gyroscope_refused;
    FixResiduals used, held_out;
};

/** A keyframe at every fix, tied by the wheels' increments, the gyroscope's turns (bias unknown,
 *  constant) and a weak prior that the ground is level and even; fixes as robust position factors
 *  with the antenna's lever arm. The scale of the wheels is measured by the fixes beforehand.
 * Heading and place start from the rigid motion that lays the dead reckoning over the fixes. Of
 * every `hold_out_every` fixes one is left out, to check the rest. Where
 * GpsOptions::wheel_slip_share is left open, the value is taken with which fixes predict each other
 * best (cross-validation). \throws Error when wheels or fixes are too few, or the robot moved too
 * little to tell its heading
 */
GpsFusionResult fuseGps(const GpsFusionInput& input, const GpsOptions& options);

}  // namespace rgbd_graphslam
