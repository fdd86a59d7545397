/** What to change so that a wrong sensor is imported right. */
#pragma once
#include <string>

#include "rgbd_graphslam/dataset/odometry_check.h"
#include "rgbd_graphslam/dataset/sensor_verdict.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** How a recording says that an IMU is mounted. */
struct ImuMount {
    SE3 T_base_sensor, T_base_imu;
};

/** "import with --imu-gyro-unit deg/s and imu_pose = [0 0 0 90 0 0] in camera.ini"; empty when no
 *  option puts it right.
 *  \param gyroscope or accelerometer */
std::string imuRemedy(const SensorVerdict& verdict, const ImuMount& mount, bool gyroscope);

std::string odometryRemedy(const OdometryVerdict& verdict);

/** The one line about a sensor that is left out.
 *  \param kind "gyroscope", ... \param label its sensorLabel in the rawlog */
std::string wrongSensorText(const std::string& kind, const std::string& label,
                            const SensorVerdict& verdict, const std::string& remedy);

}  // namespace rgbd_graphslam
