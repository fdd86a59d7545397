#include "motion_json.h"

namespace rgbd_graphslam {
namespace {

using Json = nlohmann::ordered_json;

Json rateOf(std::size_t readings, double span_s) {
    if (!(span_s > 0)) return nullptr;
    return static_cast<double>(readings - 1) / span_s;
}

Json listOf(const Eigen::Vector3d& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

Json spreadOf(const ResidualSpread& spread) {
    if (spread.count == 0) return nullptr;
    return {{"mean_square", spread.mean()}, {"expected", 1}, {"count", spread.count}};
}

Json imuJson(const MotionSummary& motion, const std::optional<StampDelay>& delay) {
    if (motion.imu_readings == 0) return nullptr;
    Json imu = {{"readings", motion.imu_readings},
                {"rate_hz", rateOf(motion.imu_readings, motion.imu_span_s)},
                {"longest_gap_s", motion.imu_gap_s},
                {"used", motion.imu_used}};
    if (delay) {
        imu["stamps_late_s"] = delay->delay_s;
        imu["stamps_late_sigma_s"] = delay->sigma_s;
    }
    if (!motion.imu_used) return imu;
    imu["restarts"] = motion.restarts;
    imu["gyro_bias_rad_s"] = listOf(motion.bias.gyro);
    imu["gyro_bias_sigma_rad_s"] = motion.gyro_bias_sigma;
    imu["accelerometer_bias_m_s2"] = listOf(motion.bias.accelerometer);
    imu["accelerometer_bias_sigma_m_s2"] = motion.accelerometer_bias_sigma;
    imu["gyro_noise_rad_s_sqrt_hz"] = motion.gyro_noise;
    imu["accelerometer_noise_m_s2_sqrt_hz"] = motion.accelerometer_noise;
    imu["residuals"] = spreadOf(motion.poses);
    return imu;
}

Json wheelsJson(const MotionSummary& motion) {
    if (motion.wheel_readings == 0) return nullptr;
    Json wheels = {{"readings", motion.wheel_readings},
                   {"rate_hz", rateOf(motion.wheel_readings, motion.wheel_span_s)},
                   {"longest_gap_s", motion.wheel_gap_s},
                   {"compared", motion.wheels_compared}};
    if (motion.wheels_compared == 0) return wheels;
    wheels["scale"] = motion.wheel_scale;
    wheels["scale_sigma"] = motion.wheel_scale_sigma;
    wheels["residuals"] = spreadOf(motion.wheels);
    wheels["slips_s"] = Json::array();
    for (const auto& [from_s, to_s] : motion.slips) wheels["slips_s"].push_back({from_s, to_s});
    return wheels;
}

}  // namespace

nlohmann::ordered_json motionJson(const MotionSummary& motion,
                                  const std::optional<StampDelay>& imu_delay) {
    return {{"imu", imuJson(motion, imu_delay)}, {"wheels", wheelsJson(motion)}};
}

}  // namespace rgbd_graphslam
