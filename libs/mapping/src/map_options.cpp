#include "rgbd_graphslam/mapping/map_options.h"

namespace rgbd_graphslam {

void MapOptions::describe(OptionVisitor& v) {
    v.real("point_voxel_m", point_voxel_m, 0.001, 1, "m",
           "Readings within one voxel become one point");
    v.real("octree_resolution_m", octree_resolution_m, 0.005, 1, "m",
           "Edge of the octree's leaves");
    v.real("grid_resolution_m", grid_resolution_m, 0.005, 1, "m", "Edge of the 2-D grid's cells");
    v.real("mesh_voxel_m", mesh_voxel_m, 0, 1, "m",
           "Edge of the voxels that a mesh is made of, about that of its triangles; 0: no mesh");
    v.real("mesh_min_part_m2", mesh_min_part_m2, 0, 100, "m^2",
           "Parts of the mesh that hang on nothing and are smaller are left out");
    v.real("z_min_m", z_min_m, -10, 10, "m",
           "Obstacles of the grid start this high above the floor");
    v.real("z_max_m", z_max_m, -10, 20, "m", "Obstacles of the grid end this high above the floor");
    v.real("min_range_m", min_range_m, 0, 10, "m", "Nearer readings are left out");
    v.real("max_range_m", max_range_m, 0.5, 100, "m",
           "Farther readings make no surface; space is carved free up to here");
    v.real("edge_ratio", edge_ratio, 0.001, 1, "",
           "A reading that jumps from a neighbour by more than this share of its depth is an edge");
    v.real("hit_share", hit_share, 0, 1, "",
           "Share of a leaf's pixels that must fall into it for a keyframe to find it occupied");
    v.flag("drop_points_in_free_space", drop_points_in_free_space,
           "Leave out points and triangles where most views look through, e.g. of who walked by");
    v.choice("upright", upright, {"gravity", "floor", "none"},
             "z = up by the accelerometer (floor when there is none), the floor, the first camera");
    v.integer("memory_limit_mb", memory_limit_mb, 64, 1000000, "MB",
              "A map that would need more is refused");
}

}  // namespace rgbd_graphslam
