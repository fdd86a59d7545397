/** Scan alignment by point-to-line ICP. */
#pragma once
#include <optional>

#include "rgbd_graphslam/laser/point_index.h"

namespace rgbd_graphslam {

/** What is known of a pose beforehand. */
struct PlanarPrior {
    PlanarPose mean;
    /** Inverse covariance of (x, y, yaw) in the frame of `mean`, m and rad. */
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

/** Where a scan lies in a reference. */
struct ScanAlignment {
    PlanarPose T_ref_scan;
    /** Inverse covariance of (x, y, yaw) in the scan's frame, of the points alone. Small where
     *  nothing holds the scan, as along a corridor. */
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    /** Of the scan's points with normals, those that lie on the reference, 0 to 1. */
    double inlier_share = 0;
    std::size_t inliers = 0;
    /** Of the inliers' distances to their lines, m. */
    double rms_m = 0;
};

/** How scans are aligned. */
struct AlignmentOptions {
    double first_gate_m = 0.5, last_gate_m = 0.15;
    /** Standard deviation of a point's distance to its line, m. */
    double sigma_m = 0.05;
    int iterations = 12;
};

/** Minimizes the distances of the scan's points to the lines through their nearest neighbors
 *  (Censi, "An ICP variant using a point-to-line metric", ICRA 2008) with Cauchy weights, by
 *  Gauss-Newton, together with the prior. The information is the Hessian of the last iteration
 *  (Censi, "An accurate closed-form estimate of ICP's covariance", ICRA 2007, without the term of
 *  the reference). Nothing where fewer than five points meet the reference or, without a prior,
 *  where a direction is not constrained at all. */
std::optional<ScanAlignment> alignScan(const PointIndex& reference,
                                       const std::vector<ScanPoint>& scan, const PlanarPose& guess,
                                       const std::optional<PlanarPrior>& prior,
                                       const AlignmentOptions& options);

}  // namespace rgbd_graphslam
