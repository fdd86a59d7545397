#include "rgbd_graphslam/dataset/sensor_remedy.h"

#include <cmath>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/sensor_units.h"
#include "rgbd_graphslam/dataset/signed_axes.h"
#include "verdict_text.h"

namespace rgbd_graphslam {
namespace {

/** "--option deg/s"; empty when the unit is right. */
std::string unitOption(const std::string& option, const std::vector<SensorUnit>& units,
                       double factor) {
    if (factor == 1) return "";
    if (const auto unit = unitOfFactor(units, factor, 0.15)) return option + " " + unit->name;
    // A negative value would be taken for an option of its own without the equals sign.
    const auto unit = unitOfFactor(units, -factor, 0.15);
    return option + "=" + factorText(unit ? -1 / unit->per_ours : 1 / factor);
}

/** `[x y z yaw pitch roll]` in m and degrees. */
std::string poseText(const SE3& pose) {
    const mrpt::poses::CPose3D mrpt_pose = toCPose3D(pose);
    std::string text = "[";
    for (const double value : {pose.t.x(), pose.t.y(), pose.t.z()}) text += factorText(value) + " ";
    const auto degrees = [](double angle) {
        return std::to_string(std::lround(angle * 180 / M_PI));
    };
    return text + degrees(mrpt_pose.yaw()) + " " + degrees(mrpt_pose.pitch()) + " " +
           degrees(mrpt_pose.roll()) + "]";
}

std::string joined(const std::string& first, const std::string& second) {
    const std::string both = first.empty() || second.empty() ? "" : " and ";
    return first + both + second;
}

std::string importWith(const std::string& remedy) {
    return remedy.empty() ? "" : "import with " + remedy;
}

}  // namespace

std::string imuRemedy(const SensorVerdict& verdict, const ImuMount& mount, bool gyroscope) {
    if (verdict.fault == SensorFault::Unusable) return "";
    const bool negated = mirrored(verdict.axes);
    const std::string unit = unitOption(gyroscope ? "--imu-gyro-unit" : "--imu-accel-unit",
                                        gyroscope ? angularVelocityUnits() : accelerationUnits(),
                                        negated ? -verdict.factor : verdict.factor);
    const Eigen::Matrix3d turn = negated ? Eigen::Matrix3d(-verdict.axes) : verdict.axes;
    if (turn.isIdentity()) return importWith(unit);
    SE3 T_sensor_imu = mount.T_base_sensor.inverse() * mount.T_base_imu;
    T_sensor_imu.R = T_sensor_imu.R * turn;
    return importWith(joined(unit, "imu_pose = " + poseText(T_sensor_imu) + " in camera.ini")) +
           (verdict.other_axes_fit ? " (the simplest that fits: the camera turned too little to "
                                     "tell all axes)"
                                   : "");
}

std::string odometryRemedy(const OdometryVerdict& verdict) {
    const bool negated = verdict.axes.topLeftCorner<2, 2>().isApprox(-Eigen::Matrix2d::Identity());
    const std::string way =
        unitOption("--odometry-unit", lengthUnits(), negated ? -verdict.factor : verdict.factor);
    double heading_factor = verdict.heading_factor;
    if (std::abs(std::abs(heading_factor) - 1) < 0.3)
        heading_factor = std::copysign(1, heading_factor);
    return importWith(
        joined(way, unitOption("--odometry-heading-unit", angleUnits(), heading_factor)));
}

std::string wrongSensorText(const std::string& kind, const std::string& label,
                            const SensorVerdict& verdict, const std::string& remedy) {
    return kind + " '" + label +
           "' contradicts the camera's tracked motion and is left out: " + verdict.finding +
           (remedy.empty() ? "" : "; " + remedy);
}

}  // namespace rgbd_graphslam
