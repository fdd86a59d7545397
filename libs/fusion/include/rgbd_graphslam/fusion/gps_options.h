/** Settings of GPS. */
#pragma once
#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {

/** Section `[GpsOptions]`. */
struct GpsOptions : Options {
    double sigma_m = 0;
    double outlier_sigmas = 3;
    int hold_out_every = 0;
    double wheel_slip_share = 0;
    double wheel_yaw_share = 0.2;
    double gyro_noise_rad_sqrt_s = 0.003;

    const char* section() const override { return "GpsOptions"; }
    const char* about() const override { return "GPS with wheels and gyroscope, without a camera"; }
    void describe(OptionVisitor& v) override;
};

}  // namespace rgbd_graphslam
