#include "rgbd_graphslam/features/feature_options.h"

namespace rgbd_graphslam {

void FeatureOptions::describe(OptionVisitor& v) {
    v.integer("count", count, 50, 10000, "", "Target number of keypoints per image");
    v.integer("levels", levels, 1, 12, "", "Number of image pyramid levels");
    v.real("scale_factor", scale_factor, 1.05, 2.0, "",
           "Scale factor between consecutive pyramid levels");
    v.integer("fast_threshold", fast_threshold, 2, 100, "gray levels",
              "FAST threshold in well-textured cells");
    v.integer("fast_threshold_min", fast_threshold_min, 1, 100, "gray levels",
              "FAST threshold used in cells that would otherwise have no keypoints");
    v.integer("cell_px", cell_px, 8, 200, "px",
              "Size of the grid cells used to spread keypoints evenly");
    v.real("depth_min_m", depth_min_m, 0, 10, "m", "Minimum valid depth");
    v.real("depth_max_m", depth_max_m, 0, 100, "m",
           "Maximum valid depth; 0 = automatic: 10, or more where most of the recording is farther "
           "away");
    v.real("depth_edge_step", depth_edge_step, 0.001, 1, "1/m",
           "Depth discontinuity threshold around a keypoint: depth step / depth^2 (scales with the "
           "noise)");
}

}  // namespace rgbd_graphslam
