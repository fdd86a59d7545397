/** What is done to an estimated trajectory before it is evaluated. */
#pragma once

namespace rgbd_graphslam {

/** Offset and scale of an estimate, as the TUM tools have them. */
struct EstimateOptions {
    double offset_s = 0;  // added to its stamps
    double scale = 1;     // factor on its positions
};

}  // namespace rgbd_graphslam
