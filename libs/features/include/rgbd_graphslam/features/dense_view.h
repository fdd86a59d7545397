/** An image small enough to be aligned as a whole. */
#pragma once
#include <vector>

#include "rgbd_graphslam/geometry/pixel_blocks.h"

namespace rgbd_graphslam {

/** Gray and depth at some 80 columns, undistorted; row by row. */
struct DenseView {
    /** Of the small image, without distortion. */
    Camera camera = Intrinsics{0, 0, 1, 1, 0, 0, {}};
    std::vector<float> gray;     // 0 to 255
    std::vector<float> depth_m;  // along the optical axis; 0 = none

    bool empty() const { return gray.empty(); }
    /** Share of the pixels that have depth. */
    double depthShare() const;
    /** Standard deviation of the gray values. */
    double contrast() const;
};

/** At half the size; depth is that of the nearest surface among the four. */
DenseView halved(const DenseView& view);

}  // namespace rgbd_graphslam
