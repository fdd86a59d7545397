/** Texts and scales over the 3-D view. */
#pragma once
#include <nanogui/opengl.h>

#include <opencv2/core/types.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "rgbd_graphslam/mapping/view_scale.h"

namespace rgbd_graphslam {

struct SceneOverlay {
    /** Between the panels, where scales are drawn. */
    cv::Rect area;
    double m_per_px = 0.01;  // in the middle of the view
    std::vector<SceneLabel> labels;
    /** Lowest and highest of the colors' range, where they stand for heights. */
    std::optional<std::pair<double, double>> heights_m;
};

/** Within a frame of NanoVG, in the window's own units. */
void drawSceneOverlay(NVGcontext* context, const SceneOverlay& overlay);

}  // namespace rgbd_graphslam
