#include "motion_lists.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "number_text.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
using namespace mrpt::obs;
namespace {

using Triple = std::array<double, 3>;

bool isFinite(const Triple& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool isFinite(const SE3& pose) {
    return pose.R.allFinite() && pose.t.allFinite();
}

std::optional<Triple> valuesOf(const CObservationIMU& imu,
                               const std::array<TIMUDataIndex, 3>& axes) {
    Triple values;
    for (int i = 0; i < 3; ++i) {
        if (!imu.has(axes[i])) return std::nullopt;
        values[i] = imu.get(axes[i]);
    }
    return values;
}

}  // namespace

void MotionLists::append(std::string& list, const char* header, double stamp_s,
                         const Triple& values) const {
    if (list.empty()) list = header;
    list += stampText(stamp_s);
    for (const double value : values) list += " " + shortest(value);
    list += "\n";
}

bool MotionLists::isChosen(const std::string& list, const std::string& label) {
    if (chosen_label_.emplace(list, label).first->second == label) return true;
    ++of_others_[label];
    return false;
}

bool MotionLists::isUsable(const CObservation& observation, bool finite) {
    const bool usable = finite && observation.timestamp != INVALID_TIMESTAMP;
    unusable_ += !usable;
    return usable;
}

void MotionLists::take(const CObservation& observation) {
    if (const auto* reading = dynamic_cast<const CObservationIMU*>(&observation)) {
        takeImu(*reading);
    } else if (const auto* wheels = dynamic_cast<const CObservationOdometry*>(&observation)) {
        takeOdometry(*wheels);
    } else if (const auto* pose = dynamic_cast<const CObservationRobotPose*>(&observation)) {
        takeTruth(*pose);
    }
}

void MotionLists::takeImu(const CObservationIMU& reading) {
    const auto linear = valuesOf(reading, {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC});
    const auto angular = valuesOf(reading, {IMU_WX, IMU_WY, IMU_WZ});
    if (!linear && !angular) return;
    const SE3 pose = toSE3(reading.sensorPose);
    const bool finite = isFinite(pose) && isFinite(linear.value_or(Triple())) &&
                        isFinite(angular.value_or(Triple()));
    if (!isUsable(reading, finite)) return;
    const bool takes_linear = linear && isChosen("accelerometer", reading.sensorLabel);
    const bool takes_angular = angular && isChosen("gyroscope", reading.sensorLabel);
    if (!takes_linear && !takes_angular) return;
    if (imu++ == 0) T_base_imu = pose;
    const double stamp_s = toSeconds(reading.timestamp);
    if (takes_linear) {
        append(acceleration, "# accelerometer data\n# timestamp ax ay az\n", stamp_s, *linear);
    }
    if (takes_angular) {
        append(angular_velocity, "# gyroscope data\n# timestamp wx wy wz\n", stamp_s, *angular);
    }
}

void MotionLists::takeOdometry(const CObservationOdometry& wheels) {
    const auto& pose = wheels.odometry;
    const Triple values = {pose.x(), pose.y(), pose.phi()};
    if (!isUsable(wheels, isFinite(values)) || !isChosen("odometry", wheels.sensorLabel)) return;
    ++odometry;
    append(odometry_list, "# odometry\n# timestamp x y theta\n", toSeconds(wheels.timestamp),
           values);
}

void MotionLists::takeTruth(const CObservationRobotPose& truth) {
    if (truth.sensorLabel != ground_truth_label) return;
    const SE3 pose = toSE3(truth.pose.mean);
    if (isUsable(truth, isFinite(pose))) {
        truth_of_base.push_back({toSeconds(truth.timestamp), pose});
    }
}

std::vector<std::string> MotionLists::notes() const {
    std::vector<std::string> notes;
    if (unusable_ > 0) {
        notes.push_back(std::to_string(unusable_) +
                        " readings of motion sensors left out: without a timestamp or not finite");
    }
    for (const auto& [label, readings] : of_others_) {
        notes.push_back(std::to_string(readings) + " readings of '" + label +
                        "' left out: a TUM folder has room for one sensor of a kind");
    }
    return notes;
}

}  // namespace rgbd_graphslam
