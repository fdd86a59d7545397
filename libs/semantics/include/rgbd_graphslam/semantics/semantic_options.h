/** Settings of labeled maps. */
#pragma once
#include <string>

#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {

/** Section `[SemanticOptions]`. */
struct SemanticOptions : Options {
    std::string moving_classes;
    std::string model;
    std::string model_labels;
    bool model_has_background = true;
    int model_width = 0;
    int model_height = 0;
    double model_scale = 1.0 / 255;
    double model_mean = 0;
    double label_voxel_m = 0.02;
    double frame_accuracy = 0.8;
    double min_confidence = 0.9;
    std::string stuff_classes =
        "wall floor ceiling outside rug road sidewalk grass ground sky building";
    double object_gap_m = 0.06;
    double min_object_m = 0.08;

    const char* section() const override { return "SemanticOptions"; }
    const char* about() const override { return "Labels of things in the map"; }
    void describe(OptionVisitor& v) override;
};

}  // namespace rgbd_graphslam
