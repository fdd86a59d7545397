/** Recordings without a camera. */
#pragma once
#include <string>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** What was written of a recording without a camera. */
struct SensorReport {
    std::size_t imu = 0, odometry = 0, others = 0;
    double duration_s = 0;
    std::vector<std::string> notes;
};

/** A few lines for the user. */
std::string toText(const SensorReport& report);

/** Writes a recording's IMU, odometry, laser scans and GPS to a rawlog, in order of time. The
 *  sequence's camera says where the IMU sits.
 *  \throws Error when there is none of them or the rawlog cannot be written */
SensorReport importSensors(const RgbdSequence& sequence, const std::string& rawlog_path);

}  // namespace rgbd_graphslam
