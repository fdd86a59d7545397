/** Absolute trajectory error: how far the poses of an estimate are from the truth once the two
 *  trajectories lie over each other. */
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/metrics/alignment.h"
#include "rgbd_graphslam/metrics/estimate_options.h"
#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {

/** How estimate and truth are associated and aligned. */
struct AteOptions : EstimateOptions {
    double max_difference_s = 0.02;  // between the stamps of an estimate and its truth, exclusive
    /** Align with the scale that fits best instead of `scale`. */
    bool fit_scale = false;
};

/** A pose of the estimate and its truth. */
struct AtePair {
    double stamp_s = 0;  // of the estimate, offset included
    Eigen::Vector3d aligned_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d truth_m = Eigen::Vector3d::Zero();

    Eigen::Vector3d error_m() const { return aligned_m - truth_m; }
};

/** Alignment and errors of one estimate. */
struct AteResult {
    /** From the positions of the estimate as given (all scales included) to the truth's frame. */
    Similarity alignment;
    /** The scale with which the estimate would fit best, as a factor on the positions as given; for
     *  an RGB-D camera also the factor by which its depth should be multiplied. None when the
     *  estimate does not move. */
    std::optional<double> fitted_scale;
    std::vector<AtePair> pairs;  // in order of time
    Statistics translation_m;
    std::size_t estimate_poses = 0;
};

/** The definition of Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS
 *  2012, with the association and figures of the benchmark's tools: poses are matched one-to-one by
 *  stamp (associate()), the matched positions are aligned by least squares, the error is the
 *  distance that is left. Of poses with the same stamp the last counts.
 *  \throws Error when fewer than two poses match, with the time spans of both trajectories */
AteResult evaluateAte(const Trajectory& estimate, const Trajectory& truth,
                      const AteOptions& options = {});

}  // namespace rgbd_graphslam
