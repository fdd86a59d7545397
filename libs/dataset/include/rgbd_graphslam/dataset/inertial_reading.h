/** What an MRPT observation of an IMU holds. */
#pragma once
#include <mrpt/obs/CObservationIMU.h>

#include <Eigen/Core>
#include <optional>

namespace rgbd_graphslam {

/** Specific force in the IMU's axes, m/s^2: 9.81 upwards at rest.
 *  \return nothing unless all three axes were measured and are finite */
std::optional<Eigen::Vector3d> specificForce(const mrpt::obs::CObservationIMU& imu);

/** Angular velocity in the IMU's axes, rad/s.
 *  \return nothing unless all three axes were measured and are finite */
std::optional<Eigen::Vector3d> angularVelocity(const mrpt::obs::CObservationIMU& imu);

}  // namespace rgbd_graphslam
