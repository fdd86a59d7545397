#include "motion_readings_collector.h"

#include <algorithm>
#include <utility>

#include "rgbd_graphslam/dataset/inertial_reading.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace {

/** Rates that wait longer for an accelerometer do without. */
constexpr std::size_t most_waiting = 1000;

}  // namespace

void MotionReadingsCollector::note(const mrpt::obs::CObservation& observation) {
    if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
        noteWheels(*odometry);
    } else if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation)) {
        noteImu(*imu);
    }
}

void MotionReadingsCollector::noteWheels(const mrpt::obs::CObservationOdometry& odometry) {
    const mrpt::poses::CPose2D& p = odometry.odometry;
    const double stamp_s = toSeconds(odometry.timestamp);
    if (!Eigen::Vector3d(p.x(), p.y(), p.phi()).allFinite() || stamp_s <= last_wheels_s_) return;
    if (!wheels_label_) wheels_label_ = odometry.sensorLabel;
    if (odometry.sensorLabel != *wheels_label_) return;
    last_wheels_s_ = stamp_s;
    wheels_.push_back({stamp_s, {p.x(), p.y(), p.phi()}});
}

void MotionReadingsCollector::noteImu(const mrpt::obs::CObservationIMU& imu) {
    const double stamp_s = toSeconds(imu.timestamp);
    const auto take = [&](const auto& value, std::optional<std::string>& label,
                          std::deque<Reading>& readings) {
        if (!value) return false;
        if (!label) label = imu.sensorLabel;
        if (imu.sensorLabel != *label) return false;
        if (!readings.empty() && stamp_s <= readings.back().stamp_s) return false;
        readings.push_back({stamp_s, *value});
        if (readings.size() > most_waiting) readings.pop_front();
        return true;
    };
    if (take(angularVelocity(imu), gyroscope_, rates_)) T_base_imu_ = toSE3(imu.sensorPose);
    take(specificForce(imu), accelerometer_, forces_);
    pair();
}

/** \return nothing before the first and after the last reading of the accelerometer */
std::optional<Eigen::Vector3d> MotionReadingsCollector::forceAt(double stamp_s) const {
    const auto after = std::lower_bound(forces_.begin(), forces_.end(), stamp_s,
                                        [](const Reading& r, double s) { return r.stamp_s < s; });
    if (after == forces_.end()) return std::nullopt;
    if (after->stamp_s == stamp_s) return after->value;
    if (after == forces_.begin()) return std::nullopt;
    const Reading& before = *(after - 1);
    const double share = (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s);
    return (1 - share) * before.value + share * after->value;
}

void MotionReadingsCollector::pair() {
    while (!rates_.empty() && !forces_.empty() &&
           rates_.front().stamp_s <= forces_.back().stamp_s) {
        const Reading rate = rates_.front();
        rates_.pop_front();
        const auto force = forceAt(rate.stamp_s);
        if (!force || rate.stamp_s <= last_imu_s_) continue;
        last_imu_s_ = rate.stamp_s;
        imu_.push_back({rate.stamp_s, rate.value, *force});
    }
    while (forces_.size() > 1 && !rates_.empty() && forces_[1].stamp_s <= rates_.front().stamp_s) {
        forces_.pop_front();
    }
    while (forces_.size() > 1 && rates_.empty() && forces_[1].stamp_s <= last_imu_s_) {
        forces_.pop_front();
    }
}

MotionReadings MotionReadingsCollector::take(const SE3& T_base_cam) {
    MotionReadings readings;
    readings.imu = std::exchange(imu_, {});
    readings.T_imu_cam = T_base_imu_.inverse() * T_base_cam;
    readings.wheels = std::exchange(wheels_, {});
    readings.T_base_cam = T_base_cam;
    return readings;
}

}  // namespace rgbd_graphslam
