#include "rgbd_graphslam/mapping/map_options.h"

namespace rgbd_graphslam {

void MapOptions::describe(OptionVisitor& v) {
    v.real("point_voxel_m", point_voxel_m, 0.001, 1, "m", "Voxel size of the point cloud");
    v.real("octree_resolution_m", octree_resolution_m, 0.005, 1, "m", "Leaf size of the octree");
    v.real("grid_resolution_m", grid_resolution_m, 0.005, 1, "m", "Cell size of the 2-D grid");
    v.real("mesh_voxel_m", mesh_voxel_m, 0, 1, "m",
           "Voxel size of the mesh, roughly its triangle size (0 = no mesh)");
    v.real("mesh_min_part_m2", mesh_min_part_m2, 0, 100, "m^2",
           "Disconnected mesh components smaller than this are removed");
    v.real("z_min_m", z_min_m, -10, 10, "m",
           "Lower bound of the obstacle height band of the grid, above the floor");
    v.real("z_max_m", z_max_m, -10, 20, "m",
           "Upper bound of the obstacle height band of the grid, above the floor");
    v.real("min_range_m", min_range_m, 0, 10, "m", "Minimum range; closer readings are ignored");
    v.real("max_range_m", max_range_m, 0.5, 100, "m",
           "Maximum range; farther readings add no surface but still clear space up to this range");
    v.real("edge_ratio", edge_ratio, 0.001, 1, "",
           "Relative depth jump to a neighboring pixel that marks a depth edge");
    v.real(
        "hit_share", hit_share, 0, 1, "",
        "Share of the pixels covering a leaf that must hit it for a keyframe to mark it occupied");
    v.flag("drop_points_in_free_space", drop_points_in_free_space,
           "Remove points and triangles that most views see through, such as people walking by");
    v.choice("upright", upright, {"gravity", "floor", "none"},
             "Direction of z: up by the accelerometer (floor if there is none), by the floor, or "
             "as the first camera");
    v.integer("memory_limit_mb", memory_limit_mb, 64, 1000000, "MB",
              "Memory limit; larger maps are refused");
}

}  // namespace rgbd_graphslam
