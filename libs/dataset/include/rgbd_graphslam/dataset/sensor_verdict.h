/** What comparing a sensor with the camera's tracked motion has shown. */
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

namespace rgbd_graphslam {

/** What is wrong with a sensor's readings. */
enum class SensorFault {
    /** Too little motion, or too few readings, to tell. */
    Undecided,
    /** Compared, and in agreement. */
    None,
    Unit,
    Axes,
    Sign,
    TimeOffset,
    /** Wrong in a way that no single correction explains. */
    Unusable,
};

/** By how much a sensor's stamps are too late, and its standard deviation, s. */
struct StampDelay {
    double delay_s = 0, sigma_s = 0;
};

/** The fault of a sensor, its evidence, and the correction. */
struct SensorVerdict {
    SensorFault fault = SensorFault::Undecided;
    /** What is wrong and the value that would be right; empty without a fault. */
    std::string finding;
    /** Right readings are axes * reading / factor. */
    double factor = 1;
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    /** The motion leaves other axes possible; these are the simplest that fit. */
    bool other_axes_fit = false;
    /** By how much the sensor's stamps are too late, s. */
    double delay_s = 0;

    /** The same as measured, however small, where it can be told. */
    std::optional<StampDelay> measured_delay;

    bool wrong() const { return fault > SensorFault::None; }
};

}  // namespace rgbd_graphslam
