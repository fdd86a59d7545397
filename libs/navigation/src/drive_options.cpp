#include "rgbd_graphslam/navigation/drive_options.h"

namespace rgbd_graphslam {

void DriveOptions::describe(OptionVisitor& v) {
    v.choice("follow", follow, {"motion", "route"},
             "Follow waypoints of PlannerRRT_SE2_TPS (motion) or of PlannerSimple2D (route)");
    v.real("planning_margin_m", planning_margin_m, 0, 1, "m",
           "Safety margin between body and obstacles in planning");
    v.real("leg_m", leg_m, 0.5, 100, "m", "Length of route the RRT plans at a time");
    v.real("rrt_limit_s", rrt_limit_s, 0.1, 3600, "s", "Planning time limit of the RRT per leg");
    v.real("waypoint_radius_m", waypoint_radius_m, 0.05, 5, "m",
           "Distance at which a waypoint counts as reached");
    v.real("goal_radius_m", goal_radius_m, 0.02, 5, "m",
           "Distance at which the goal counts as reached");
    v.real("sensor_range_m", sensor_range_m, 0.5, 30, "m", "Range of the simulated sensor");
    v.real("floor_clearance_m", floor_clearance_m, 0.01, 1, "m",
           "Points below this height are floor, not obstacles");
    v.real("body_clearance_m", body_clearance_m, 0.001, 1, "m",
           "Ground clearance of the body, for the check against the true surface");
    v.real("obstacle_voxel_m", obstacle_voxel_m, 0.005, 0.5, "m",
           "Voxel size to which the simulated scan is thinned");
    v.real("control_period_s", control_period_s, 0.01, 1, "s", "Control period of the navigator");
    v.real("motor_lag_s", motor_lag_s, 0, 2, "s", "Time constant of the motors");
    v.real("time_limit_s", time_limit_s, 1, 100000, "s", "Simulated time limit of a drive");
}

}  // namespace rgbd_graphslam
