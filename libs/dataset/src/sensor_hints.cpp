#include "rgbd_graphslam/dataset/sensor_hints.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "rgbd_graphslam/dataset/accelerometer_check.h"
#include "rgbd_graphslam/dataset/sensor_units.h"
#include "verdict_text.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t fewest_readings = 20;
constexpr double fastest_turning_rad_s = 20, fastest_driving_m_s = 20;
/** Steps between readings that come in bursts say nothing about speed. */
constexpr double least_step_s = 0.005;

/** The value that one of a hundred exceeds: a few glitches are no wrong unit. */
double peak(std::vector<double> values) {
    if (values.size() < fewest_readings) return 0;
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

/** Of position or heading, between readings. */
double peakSpeed(const std::vector<StampedVector>& readings, bool of_heading) {
    std::vector<double> speeds;
    for (std::size_t i = 1; i < readings.size(); ++i) {
        const double passed_s = readings[i].stamp_s - readings[i - 1].stamp_s;
        const Eigen::Vector3d step = readings[i].value - readings[i - 1].value;
        if (passed_s < least_step_s || !step.allFinite()) continue;
        const double turned = std::abs(std::remainder(step.z(), 2 * M_PI));
        speeds.push_back((of_heading ? turned : step.head<2>().norm()) / passed_s);
    }
    return peak(std::move(speeds));
}

std::string expected(const std::string& sensor, const std::string& what, const std::string& limit,
                     const std::string& guess, const std::string& option) {
    return sensor + ": " + what + " where at most " + limit + " is plausible; if it is in " +
           guess + ", import with " + option + " " + guess;
}

std::optional<std::string> gyroscopeHint(const std::vector<StampedVector>& readings) {
    std::vector<double> rates;
    for (const auto& reading : readings) {
        if (reading.value.allFinite()) rates.push_back(reading.value.norm());
    }
    const double fastest = peak(std::move(rates));
    if (fastest < fastest_turning_rad_s) return std::nullopt;
    return expected("gyroscope", "it turns at " + factorText(fastest) + " rad/s", "20 rad/s",
                    "deg/s", "--imu-gyro-unit");
}

std::optional<std::string> drivingHint(const std::vector<StampedVector>& readings) {
    const double fastest = peakSpeed(readings, false);
    if (fastest < fastest_driving_m_s) return std::nullopt;
    constexpr double likely_in_mm = 200;  // 0.2 m/s
    return expected("odometry", "it drives at " + factorText(fastest) + " m/s", "20 m/s",
                    fastest > likely_in_mm ? "mm" : "cm", "--odometry-unit");
}

std::optional<std::string> headingHint(const std::vector<StampedVector>& readings) {
    // Headings in rad are told from those in degrees by going beyond a full turn as well.
    double farthest = 0;
    for (const auto& reading : readings) {
        if (std::isfinite(reading.value.z())) {
            farthest = std::max(farthest, std::abs(reading.value.z()));
        }
    }
    const double fastest = peakSpeed(readings, true);
    if (fastest < fastest_turning_rad_s || farthest < 2 * M_PI) return std::nullopt;
    return expected("odometry", "its heading turns at " + factorText(fastest) + " rad/s",
                    "20 rad/s", "deg", "--odometry-heading-unit");
}

std::optional<std::string> accelerometerHint(const std::vector<StampedVector>& readings) {
    // Without poses only the length is judged.
    const SensorVerdict verdict = checkAccelerometer(readings, {});
    if (!verdict.wrong()) return std::nullopt;
    const auto unit = unitOfFactor(accelerationUnits(), verdict.factor, 0.15);
    std::string hint = "accelerometer: " + verdict.finding;
    if (verdict.fault == SensorFault::Unit) {
        hint += "; import with --imu-accel-unit " +
                (unit ? unit->name : factorText(1 / verdict.factor));
    }
    return hint;
}

void scale(std::vector<StampedVector>& readings, const Eigen::Vector3d& factors) {
    for (StampedVector& reading : readings) reading.value = reading.value.cwiseProduct(factors);
}

}  // namespace

RgbdSequence inOurUnits(RgbdSequence sequence, const SensorUnitValues& units) {
    scale(sequence.acceleration, Eigen::Vector3d::Constant(units.acceleration));
    scale(sequence.angular_velocity, Eigen::Vector3d::Constant(units.angular_velocity));
    scale(sequence.odometry, {units.length, units.length, units.heading});
    return sequence;
}

std::vector<std::string> sensorHints(const RgbdSequence& sequence) {
    std::vector<std::string> hints;
    for (const auto& hint :
         {accelerometerHint(sequence.acceleration), gyroscopeHint(sequence.angular_velocity),
          drivingHint(sequence.odometry), headingHint(sequence.odometry)}) {
        if (hint) hints.push_back(*hint);
    }
    return hints;
}

}  // namespace rgbd_graphslam
