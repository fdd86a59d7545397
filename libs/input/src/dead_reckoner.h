/** Where wheels and gyroscope say the camera is. */
#pragma once
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <optional>
#include <string>

#include "rgbd_graphslam/features/frame.h"

namespace rgbd_graphslam {

/** Takes the entries of a rawlog in their order and tells the dead-reckoned pose at each frame.
 * Both poses are in a frame of their own and drift. Of each kind the sensor that comes first is
 * used. Steps of the wheels faster than 20 m/s and turning faster than 50 rad/s are not believed:
 * until the next reading that can be, nothing is told, and the step counts as none. */
class DeadReckoner {
  public:
    /** Entries of other classes are passed over. */
    void note(const mrpt::obs::CObservation& observation);

    /** \param T_base_cam of the camera on the robot; \param stamp_s not before the last entry's */
    DeadReckoning at(double stamp_s, const SE3& T_base_cam) const;

  private:
    struct Wheels {
        double stamp_s = 0;
        SE3 T_odometry_base;
        bool believed = true;
    };
    void noteWheels(const mrpt::obs::CObservationOdometry& odometry);
    SE3 wheelsAt(double stamp_s) const;

    std::optional<std::string> wheels_label_;
    std::optional<Wheels> wheels_, wheels_before_;
    /** Takes back the steps that are not believed. */
    SE3 T_odometry_reported_;

    struct Gyroscope {
        double stamp_s = 0;
        Eigen::Matrix3d R_start_base = Eigen::Matrix3d::Identity();
        Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();  // in the base's axes
        bool believed = true;
    };
    void noteGyroscope(const mrpt::obs::CObservationIMU& imu);

    std::optional<std::string> gyroscope_label_;
    std::optional<Gyroscope> gyroscope_;
};

}  // namespace rgbd_graphslam
