/** What the dense maps are like. */
#pragma once
#include <string>

#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {

/** Section `[MapOptions]`. */
struct MapOptions : Options {
    double point_voxel_m = 0.01;
    double octree_resolution_m = 0.05;
    double grid_resolution_m = 0.05;
    double mesh_voxel_m = 0;
    double mesh_min_part_m2 = 0.02;
    double z_min_m = 0.1;
    double z_max_m = 1.5;
    double min_range_m = 0.3;
    double max_range_m = 5.0;
    double edge_ratio = 0.03;
    double hit_share = 0.05;
    bool drop_points_in_free_space = true;
    std::string upright = "gravity";
    int memory_limit_mb = 4096;

    const char* section() const override { return "MapOptions"; }
    const char* about() const override { return "Dense maps built from the keyframes"; }
    void describe(OptionVisitor& v) override;
};

}  // namespace rgbd_graphslam
