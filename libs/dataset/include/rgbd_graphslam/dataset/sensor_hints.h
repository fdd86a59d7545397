/** Units of a recording's IMU and odometry: put right when told, doubted when implausible. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** What one unit of each list is in the project's: m/s^2, rad/s, m and rad. Negative ones reverse
 *  the readings. */
struct SensorUnitValues {
    double acceleration = 1, angular_velocity = 1, length = 1, heading = 1;
};

/** The sequence with readings in the project's units. */
RgbdSequence inOurUnits(RgbdSequence sequence, const SensorUnitValues& units);

/** One line for each sensor whose readings no camera's motion explains: a median acceleration that
 *  is not gravity's, turning beyond 20 rad/s, driving beyond 20 m/s. Nothing is compared with the
 *  images; see checkAccelerometer(), checkGyroscope(), checkOdometry() for that. */
std::vector<std::string> sensorHints(const RgbdSequence& sequence);

}  // namespace rgbd_graphslam
