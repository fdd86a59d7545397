/** Readings of inertial sensors and wheels, as they are. */
#pragma once
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/features/frame.h"

namespace rgbd_graphslam {

/** Gathers what frames carry as MotionReadings. Of each kind the sensor that comes first is used.
 *  Accelerometer and gyroscope may be one sensor, or two in one place whose readings come at
 *  different moments: the accelerometer's are interpolated. Readings that repeat or go back in time
 *  are passed over. */
class MotionReadingsCollector {
  public:
    /** Entries of other classes are passed over. */
    void note(const mrpt::obs::CObservation& observation);

    /** What came since the last call. \param T_base_cam of the camera on the robot */
    MotionReadings take(const SE3& T_base_cam);

  private:
    struct Reading {
        double stamp_s;
        Eigen::Vector3d value;
    };
    void noteImu(const mrpt::obs::CObservationIMU& imu);
    void noteWheels(const mrpt::obs::CObservationOdometry& odometry);
    void pair();
    std::optional<Eigen::Vector3d> forceAt(double stamp_s) const;

    std::optional<std::string> gyroscope_, accelerometer_, wheels_label_;
    SE3 T_base_imu_;
    std::deque<Reading> rates_, forces_;
    double last_imu_s_ = 0, last_wheels_s_ = 0;
    std::vector<ImuSample> imu_;
    std::vector<WheelSample> wheels_;
};

}  // namespace rgbd_graphslam
