#include "dead_reckoner.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/dataset/inertial_reading.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace {

/** A sensor silent for longer is taken to be off. */
constexpr double longest_silence_s = 0.25;
/** Faster than any robot or hand that carries a depth camera. */
constexpr double fastest_m_s = 20, fastest_rad_s = 50;
/** Readings that come in bursts are stamped closer together than they were taken. */
constexpr double burst_s = 0.1;

SE3 planarPose(const mrpt::obs::CObservationOdometry& odometry) {
    const mrpt::poses::CPose2D& p = odometry.odometry;
    return {rotationExp({0, 0, p.phi()}), Eigen::Vector3d(p.x(), p.y(), 0)};
}

bool possible(const SE3& step, double passed_s) {
    const double longest_s = std::max(passed_s, burst_s);
    return step.t.norm() <= fastest_m_s * longest_s && step.angle() <= fastest_rad_s * longest_s;
}

}  // namespace

void DeadReckoner::note(const mrpt::obs::CObservation& observation) {
    if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
        noteWheels(*odometry);
    } else if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation)) {
        noteGyroscope(*imu);
    }
}

void DeadReckoner::noteWheels(const mrpt::obs::CObservationOdometry& odometry) {
    const SE3 reported = planarPose(odometry);
    if (!reported.R.allFinite() || !reported.t.allFinite()) return;
    if (!wheels_label_) wheels_label_ = odometry.sensorLabel;
    if (odometry.sensorLabel != *wheels_label_) return;
    Wheels now{toSeconds(odometry.timestamp), T_odometry_reported_ * reported};
    if (wheels_) {
        const SE3 step = wheels_->T_odometry_base.inverse() * now.T_odometry_base;
        now.believed = possible(step, now.stamp_s - wheels_->stamp_s);
    }
    if (!now.believed) {
        now.T_odometry_base = wheels_->T_odometry_base;
        T_odometry_reported_ = now.T_odometry_base * reported.inverse();
    }
    wheels_before_ = wheels_;
    wheels_ = now;
}

void DeadReckoner::noteGyroscope(const mrpt::obs::CObservationIMU& imu) {
    const auto in_imu = angularVelocity(imu);
    if (!in_imu) return;
    if (!gyroscope_label_) gyroscope_label_ = imu.sensorLabel;
    if (imu.sensorLabel != *gyroscope_label_) return;
    const Eigen::Vector3d rate = toSE3(imu.sensorPose).R * *in_imu;
    const double stamp_s = toSeconds(imu.timestamp);
    Gyroscope now{stamp_s, Eigen::Matrix3d::Identity(), rate, rate.norm() <= fastest_rad_s};
    if (gyroscope_) {
        const double passed_s = std::clamp(stamp_s - gyroscope_->stamp_s, 0.0, longest_silence_s);
        const Eigen::Vector3d mean_rate = 0.5 * (gyroscope_->rate_rad_s + rate);
        const bool both = now.believed && gyroscope_->believed;
        now.R_start_base = gyroscope_->R_start_base;
        if (both) now.R_start_base = gyroscope_->R_start_base * rotationExp(mean_rate * passed_s);
    }
    gyroscope_ = now;
}

/** Carried on as between the last two readings. */
SE3 DeadReckoner::wheelsAt(double stamp_s) const {
    if (!wheels_before_ || wheels_->stamp_s <= wheels_before_->stamp_s) {
        return wheels_->T_odometry_base;
    }
    const double between_s = wheels_->stamp_s - wheels_before_->stamp_s;
    const SE3 step = wheels_before_->T_odometry_base.inverse() * wheels_->T_odometry_base;
    const bool burst = step.t.norm() > fastest_m_s * between_s;
    const double share = burst ? 1 : (stamp_s - wheels_before_->stamp_s) / between_s;
    return wheels_before_->T_odometry_base *
           SE3(rotationExp(share * rotationLog(step.R)), share * step.t);
}

DeadReckoning DeadReckoner::at(double stamp_s, const SE3& T_base_cam) const {
    DeadReckoning reckoning;
    const auto speaks = [&](const auto& sensor) {
        return sensor && sensor->believed && stamp_s - sensor->stamp_s < longest_silence_s;
    };
    if (speaks(wheels_)) reckoning.T_odometry_cam = wheelsAt(stamp_s) * T_base_cam;
    if (speaks(gyroscope_)) {
        const double passed_s = std::max(0.0, stamp_s - gyroscope_->stamp_s);
        reckoning.R_gyroscope_cam = gyroscope_->R_start_base *
                                    rotationExp(gyroscope_->rate_rad_s * passed_s) * T_base_cam.R;
    }
    return reckoning;
}

}  // namespace rgbd_graphslam
