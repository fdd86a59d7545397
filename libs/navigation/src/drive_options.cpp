#include "rgbd_graphslam/navigation/drive_options.h"

namespace rgbd_graphslam {

void DriveOptions::describe(OptionVisitor& v) {
    v.choice("follow", follow, {"motion", "route"},
             "The waypoints of PlannerRRT_SE2_TPS (motion) or of PlannerSimple2D (route)");
    v.real("planning_margin_m", planning_margin_m, 0, 1, "m",
           "Kept between the body and obstacles when planning");
    v.real("leg_m", leg_m, 0.5, 100, "m",
           "The RRT plans from one point of the route to another so far on");
    v.real("rrt_limit_s", rrt_limit_s, 0.1, 3600, "s", "The RRT gives a leg up after this time");
    v.real("waypoint_radius_m", waypoint_radius_m, 0.05, 5, "m",
           "A waypoint nearer than this is reached");
    v.real("goal_radius_m", goal_radius_m, 0.02, 5, "m", "The goal nearer than this is reached");
    v.real("sensor_range_m", sensor_range_m, 0.5, 30, "m",
           "The simulated sensor sees points of the map up to here");
    v.real("floor_clearance_m", floor_clearance_m, 0.01, 1, "m",
           "Lower points are floor, not obstacles");
    v.real("body_clearance_m", body_clearance_m, 0.001, 1, "m",
           "The body hangs this high above the floor; for the check against the true surface");
    v.real("obstacle_voxel_m", obstacle_voxel_m, 0.005, 0.5, "m",
           "The sensor gives one point a voxel of this edge");
    v.real("control_period_s", control_period_s, 0.01, 1, "s",
           "Between two steps of the navigator");
    v.real("motor_lag_s", motor_lag_s, 0, 2, "s", "Time constant of the wheels' speed");
    v.real("time_limit_s", time_limit_s, 1, 100000, "s", "Simulated time after which to give up");
}

}  // namespace rgbd_graphslam
