/** Settings of labeled maps. */
#pragma once
#include <string>

#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {

/** Section `[SemanticOptions]`. */
struct SemanticOptions : Options {
    std::string moving_classes;
    double label_voxel_m = 0.02;
    double frame_accuracy = 0.8;
    double min_confidence = 0.6;
    std::string stuff_classes =
        "wall floor ceiling outside rug road sidewalk grass ground sky building";
    double object_gap_m = 0.06;
    double min_object_m = 0.08;

    const char* section() const override { return "SemanticOptions"; }
    const char* about() const override { return "Labels of things in the map"; }
    void describe(OptionVisitor& v) override;
};

}  // namespace rgbd_graphslam
