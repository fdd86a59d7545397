#include "rgbd_graphslam/features/feature_options.h"

namespace rgbd_graphslam {

void FeatureOptions::describe(OptionVisitor& v) {
    v.integer("count", count, 50, 10000, "", "Keypoints looked for in an image");
    v.integer("levels", levels, 1, 12, "", "Levels of the image pyramid");
    v.real("scale_factor", scale_factor, 1.05, 2.0, "", "Size ratio of neighbouring levels");
    v.integer("fast_threshold", fast_threshold, 2, 100, "grey levels",
              "Contrast of a corner where texture is rich");
    v.integer("fast_threshold_min", fast_threshold_min, 1, 100, "grey levels",
              "Contrast of a corner in cells that would stay empty");
    v.integer("cell_px", cell_px, 8, 200, "px", "Cell over which keypoints are spread evenly");
    v.real("depth_min_m", depth_min_m, 0, 10, "m", "Nearest depth that is believed");
    v.real("depth_max_m", depth_max_m, 0.5, 100, "m", "Farthest depth that is believed");
    v.real("depth_edge_step", depth_edge_step, 0.001, 1, "1/m",
           "Step around a keypoint that counts as an edge: depth step / depth^2, as noise grows");
}

}  // namespace rgbd_graphslam
