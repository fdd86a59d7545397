/** How the robot of the example plans and drives. */
#pragma once
#include <string>

#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {

/** What is ours in drive.ini; its other sections are MRPT's. */
struct DriveOptions : Options {
    std::string follow = "motion";
    double planning_margin_m = 0.02;
    double leg_m = 3;
    double rrt_limit_s = 20;
    double waypoint_radius_m = 0.25;
    double goal_radius_m = 0.2;
    double sensor_range_m = 3;
    double floor_clearance_m = 0.1;
    double body_clearance_m = 0.03;
    double obstacle_voxel_m = 0.04;
    double control_period_s = 0.1;
    double motor_lag_s = 0.1;
    double time_limit_s = 600;

    const char* section() const override { return "DriveOptions"; }
    const char* about() const override { return "Planning and simulation of rgbd-drive"; }
    void describe(OptionVisitor& v) override;
};

}  // namespace rgbd_graphslam
