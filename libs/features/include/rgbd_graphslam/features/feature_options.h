/** Settings of keypoint extraction. */
#pragma once
#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {

/** Farther, the depth of indoor cameras is noise. */
inline constexpr double default_depth_max_m = 10;

/** Section `[FeatureOptions]`. */
struct FeatureOptions : Options {
    int count = 1000;
    int levels = 6;
    double scale_factor = 1.25;
    int fast_threshold = 12;
    int fast_threshold_min = 3;
    int cell_px = 32;
    double depth_min_m = 0.2;
    /** 0 = left open: rgbd-slam looks at the recording, else default_depth_max_m. */
    double depth_max_m = 0;
    double depth_edge_step = 0.03;

    double farthestDepthM() const { return depth_max_m > 0 ? depth_max_m : default_depth_max_m; }

    const char* section() const override { return "FeatureOptions"; }
    const char* about() const override { return "Keypoint detection, descriptors and depth"; }
    void describe(OptionVisitor& v) override;
};

}  // namespace rgbd_graphslam
