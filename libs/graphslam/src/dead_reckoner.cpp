#include "dead_reckoner.h"

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace {

/** A sensor silent for longer is taken to be off. */
constexpr double longest_silence_s = 0.25;

SE3 planarPose(const mrpt::obs::CObservationOdometry& odometry) {
    const mrpt::poses::CPose2D& p = odometry.odometry;
    return {rotationExp({0, 0, p.phi()}), Eigen::Vector3d(p.x(), p.y(), 0)};
}

std::optional<Eigen::Vector3d> rotationRate(const mrpt::obs::CObservationIMU& imu) {
    using namespace mrpt::obs;
    if (!imu.has(IMU_WX) || !imu.has(IMU_WY) || !imu.has(IMU_WZ)) return std::nullopt;
    const Eigen::Vector3d in_imu(imu.get(IMU_WX), imu.get(IMU_WY), imu.get(IMU_WZ));
    return Eigen::Vector3d(toSE3(imu.sensorPose).R * in_imu);
}

}  // namespace

void DeadReckoner::note(const mrpt::obs::CObservation& observation) {
    const double stamp_s = toSeconds(observation.timestamp);
    if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
        wheels_before_ = wheels_;
        wheels_ = Wheels{stamp_s, planarPose(*odometry)};
    } else if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation)) {
        const auto rate = rotationRate(*imu);
        if (!rate) return;
        Gyroscope now{stamp_s, Eigen::Matrix3d::Identity(), *rate};
        if (gyroscope_) {
            const double passed_s =
                std::clamp(stamp_s - gyroscope_->stamp_s, 0.0, longest_silence_s);
            const Eigen::Vector3d mean_rate = 0.5 * (gyroscope_->rate_rad_s + *rate);
            now.R_start_base = gyroscope_->R_start_base * rotationExp(mean_rate * passed_s);
        }
        gyroscope_ = now;
    }
}

DeadReckoning DeadReckoner::at(double stamp_s, const SE3& T_base_cam) const {
    DeadReckoning reckoning;
    if (wheels_ && stamp_s - wheels_->stamp_s < longest_silence_s) {
        SE3 T_odometry_base = wheels_->T_odometry_base;
        if (wheels_before_ && wheels_->stamp_s > wheels_before_->stamp_s) {
            const double share =
                (stamp_s - wheels_before_->stamp_s) / (wheels_->stamp_s - wheels_before_->stamp_s);
            const SE3 step = wheels_before_->T_odometry_base.inverse() * wheels_->T_odometry_base;
            T_odometry_base = wheels_before_->T_odometry_base *
                              SE3(rotationExp(share * rotationLog(step.R)), share * step.t);
        }
        reckoning.T_odometry_cam = T_odometry_base * T_base_cam;
    }
    if (gyroscope_ && stamp_s - gyroscope_->stamp_s < longest_silence_s) {
        const double passed_s = std::max(0.0, stamp_s - gyroscope_->stamp_s);
        reckoning.R_gyroscope_cam = gyroscope_->R_start_base *
                                    rotationExp(gyroscope_->rate_rad_s * passed_s) * T_base_cam.R;
    }
    return reckoning;
}

}  // namespace rgbd_graphslam
