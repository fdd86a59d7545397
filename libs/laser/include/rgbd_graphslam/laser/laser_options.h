/** Settings of SLAM on laser scans. */
#pragma once
#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {

/** Section `[LaserOptions]`. */
struct LaserOptions : Options {
    double min_range_m = 0.1;
    double max_range_m = 30;
    double point_sigma_m = 0.05;
    double keyscan_distance_m = 0.3;
    double keyscan_angle_deg = 15;
    int submap_scans = 12;
    double odometry_xy_share = 0.1;
    double odometry_yaw_share = 0.1;
    double odometry_yaw_deg_per_m = 2;
    double loop_min_overlap = 0.6;
    double loop_max_window_m = 8;
    int refinement_rounds = 2;

    const char* section() const override { return "LaserOptions"; }
    const char* about() const override { return "SLAM on 2-D laser scans, without a camera"; }
    void describe(OptionVisitor& v) override;
};

}  // namespace rgbd_graphslam
