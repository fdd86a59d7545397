#include "rgbd_graphslam/laser/laser_options.h"

namespace rgbd_graphslam {

void LaserOptions::describe(OptionVisitor& v) {
    v.real("min_range_m", min_range_m, 0, 10, "m", "Nearer readings are left out");
    v.real("max_range_m", max_range_m, 0.5, 1000, "m",
           "Farther readings are left out; so are those at the scanner's own maximum");
    v.real("point_sigma_m", point_sigma_m, 0.001, 1, "m",
           "Standard deviation of a point's distance to the surface it was measured on");
    v.real("keyscan_distance_m", keyscan_distance_m, 0.01, 10, "m",
           "A scan this far from the last keyscan becomes one");
    v.real("keyscan_angle_deg", keyscan_angle_deg, 1, 180, "deg",
           "A scan turned this far from the last keyscan becomes one");
    v.integer("submap_scans", submap_scans, 1, 200, "",
              "Number of last keyscans that a scan is aligned to");
    v.real("odometry_xy_share", odometry_xy_share, 0.001, 1, "",
           "Standard deviation of the odometry's translation, per meter traveled");
    v.real("odometry_yaw_share", odometry_yaw_share, 0.001, 1, "",
           "Standard deviation of the odometry's heading, per radian turned");
    v.real("odometry_yaw_deg_per_m", odometry_yaw_deg_per_m, 0.01, 90, "deg",
           "Standard deviation of the odometry's heading, per meter traveled");
    v.real("loop_min_overlap", loop_min_overlap, 0.1, 1, "",
           "Share of the points that must lie on the older scans to close a loop");
    v.real("loop_max_window_m", loop_max_window_m, 0, 50, "m",
           "Largest drift that a loop may correct; 0 = no loops");
    v.integer("refinement_rounds", refinement_rounds, 0, 10, "",
              "Rounds of aligning neighboring keyscans and optimizing all of them at the end");
}

}  // namespace rgbd_graphslam
