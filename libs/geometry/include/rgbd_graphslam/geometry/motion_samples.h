/** Readings of inertial sensors and wheels. */
#pragma once
#include <Eigen/Core>

namespace rgbd_graphslam {

/** A reading in the sensor's frame. */
struct ImuSample {
    double stamp_s = 0;
    Eigen::Vector3d gyro = Eigen::Vector3d::Zero();           // rad/s
    Eigen::Vector3d accelerometer = Eigen::Vector3d::Zero();  // m/s^2, gravity included
};

/** A pose in the plane: x forward and y left (m), yaw (rad, counterclockwise). */
struct PlanarPose {
    double x = 0, y = 0, yaw = 0;

    PlanarPose operator*(const PlanarPose& other) const;
    PlanarPose inverse() const;
};

/** Where wheels tell that the robot is since they were switched on. */
struct WheelSample {
    double stamp_s = 0;
    PlanarPose T_start_base;
};

}  // namespace rgbd_graphslam
