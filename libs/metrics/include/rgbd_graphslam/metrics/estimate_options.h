/** What is done to an estimated trajectory before it is evaluated. */
#pragma once

namespace rgbd_graphslam {

struct EstimateOptions {
    double offset_s = 0;  // added to its stamps
    double scale = 1;     // factor on its positions
};

}  // namespace rgbd_graphslam
