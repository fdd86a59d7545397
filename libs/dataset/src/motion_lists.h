/** Motion sensors and ground truth of a rawlog as the text files of a TUM folder. */
#pragma once
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>

#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** Each list takes the readings of one sensor, the first that brings any; readings without a
 *  timestamp or with numbers that are not finite are left out, as no reader takes them. */
class MotionLists {
  public:
    void take(const mrpt::obs::CObservation& observation);

    /** Readings taken. */
    std::size_t imu = 0, odometry = 0;
    std::string acceleration, angular_velocity, odometry_list;
    /** Of the robot's base in the truth's world. */
    Trajectory truth_of_base;
    /** Of the first IMU reading. */
    SE3 T_base_imu;

    /** What was left out, a line each. */
    std::vector<std::string> notes() const;

  private:
    void takeImu(const mrpt::obs::CObservationIMU& reading);
    void takeOdometry(const mrpt::obs::CObservationOdometry& wheels);
    void takeTruth(const mrpt::obs::CObservationRobotPose& truth);
    /** Counts it when not. */
    bool isUsable(const mrpt::obs::CObservation& observation, bool finite);
    bool isChosen(const std::string& list, const std::string& label);
    void append(std::string& list, const char* header, double stamp_s,
                const std::array<double, 3>& values) const;

    std::map<std::string, std::string> chosen_label_;
    std::map<std::string, std::size_t> of_others_;
    std::size_t unusable_ = 0;
};

}  // namespace rgbd_graphslam
