/** The motion between two whole images, for where there are too few corners to match. */
#pragma once
#include <optional>

#include "rgbd_graphslam/features/dense_view.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A motion found by aligning two views. */
struct DenseAlignment {
    /** Maps the view's camera coordinates to the reference's. */
    SE3 T_reference_view;
    /** Share of the view's pixels with depth that fall onto the reference. */
    double overlap = 0;
};

/** Brings surfaces (point to plane, projective pairs; Newcombe et al., "KinectFusion", ISMAR 2011)
 *  and gray values (Kerl, Sturm and Cremers, "Robust odometry estimation for RGB-D cameras", ICRA
 *  2013) together by Gauss-Newton from coarse to fine. Gray values are compared after subtracting
 *  mean and dividing by deviation, so that changing light does not matter, and only where both
 * views have contrast. \param initial T_reference_view to start from \return nothing when the views
 * share too little, do not fit, or leave a direction open, as a bare wall does */
std::optional<DenseAlignment> alignDensely(const DenseView& reference, const DenseView& view,
                                           const SE3& initial);

}  // namespace rgbd_graphslam
