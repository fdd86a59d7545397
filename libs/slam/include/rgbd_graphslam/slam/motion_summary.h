/** What a run found out about its inertial sensor and wheels. */
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "rgbd_graphslam/estimation/imu_preintegration.h"

namespace rgbd_graphslam {

/** Mean of squared whitened residuals, divided by how many numbers each has: 1 where the supposed
 *  noise is right. */
struct ResidualSpread {
    double sum = 0;
    std::size_t count = 0;

    void add(double chi2, int numbers) {
        sum += chi2 / numbers;
        ++count;
    }
    double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
};

/** Of the first inertial sensor and the first wheels of a recording; summary.json tells the same. */
struct MotionSummary {
    std::size_t imu_readings = 0, wheel_readings = 0;
    /** Between the first and the last reading, and the longest time between two, s. */
    double imu_span_s = 0, imu_gap_s = 0, wheel_span_s = 0, wheel_gap_s = 0;
    /** Whether biases, velocity and gravity were ever known. */
    bool imu_used = false;
    ImuBias bias;
    /** Standard deviations of the biases, mean of the three axes. */
    double gyro_bias_sigma = 0, accelerometer_bias_sigma = 0;
    /** Noise as measured, rad/s/sqrt(Hz) and m/s^2/sqrt(Hz). */
    double gyro_noise = 0, accelerometer_noise = 0;
    /** Poses by landmarks against where the other sensors predict them. */
    ResidualSpread poses;
    /** Wheels against all else, slips left out. */
    ResidualSpread wheels;
    /** True way per way that the wheels tell, and its standard deviation. */
    double wheel_scale = 1, wheel_scale_sigma = 0;
    std::size_t wheels_compared = 0;
    /** Stretches (from, to) in which they slipped, s; those that follow each other are one. */
    std::vector<std::pair<double, double>> slips;
    /** Times at which the estimate had to begin anew, as after a gap in the readings. */
    int restarts = 0;
};

}  // namespace rgbd_graphslam
