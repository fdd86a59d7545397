/** Recordings without a camera. */
#pragma once
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>

#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/estimation/imu_preintegration.h"
#include "rgbd_graphslam/estimation/wheel_preintegration.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/input/sensor_census.h"

namespace rgbd_graphslam {

/** Which sensor a recording without a camera is mapped by. */
enum class CameralessKind { None, Laser, Gps };

/** Reads until the first RGB-D or stereo frame: None where there is one, or nothing to go by. What
 *  is damaged ends the search.
 *  \throws Error when the file is missing or not a rawlog */
CameralessKind cameralessKind(const std::string& rawlog);

/** Readings of one sensor of each kind, each by rising stamp. */
struct SensorLog {
    std::vector<SensorRecord> sensors;
    std::vector<mrpt::obs::CObservation2DRangeScan::Ptr> scans;
    std::vector<WheelSample> wheels;
    /** In the axes of the robot's base. */
    std::vector<ImuSample> imu;
    std::vector<mrpt::obs::CObservationGPS::Ptr> fixes;
    /** Ground truth, robot poses. */
    Trajectory truth;
    /** Readings left out because they were not later than the one before: scans, and others. */
    std::size_t scans_out_of_order = 0, others_out_of_order = 0;
    /** Empty when the file is whole, else where it is cut off or damaged. */
    std::string damage;
};

/** Reads a whole rawlog. Of several sensors of a kind the one that comes first is taken.
 *  \param laser_label of the scanner; empty = the first
 *  \throws Error when it is missing, or has no scanner of that label though one was asked for */
SensorLog readSensorLog(const std::string& rawlog, const std::string& laser_label);

/** The odometry's pose at a moment, interpolated; the nearest one where the moment lies up to
 *  `longest_reach_s` beyond a sample and no two samples surround it closely. */
std::optional<PlanarPose> wheelPoseAt(const std::vector<WheelSample>& wheels, double stamp_s,
                                      double longest_reach_s = 0.5);

}  // namespace rgbd_graphslam
