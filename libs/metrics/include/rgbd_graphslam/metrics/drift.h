/** Drift: how far an estimate is off after some way, in percent of the way. */
#pragma once
#include <cstddef>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/metrics/estimate_options.h"
#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {

/** Which stretches of the way are compared. */
struct DriftOptions : EstimateOptions {
    /** Lengths of the true way, m. Empty: 100 to 800 m in steps of 100, as the benchmark has them;
     *  where the way is shorter than 200 m, one to eight ninths of it. */
    std::vector<double> lengths_m;
    double max_difference_s = 0.02;  // between the stamps of an estimate and its truth, exclusive
    /** Multiply the estimate's positions by the scale that fits best instead of `scale`. */
    bool fit_scale = false;
};

/** What is left of the true motion along one stretch. */
struct DriftError {
    double from_s = 0, to_s = 0;  // stamps of the truth
    double length_m = 0;          // asked for
    double translation_percent = 0;
    double rotation_deg_m = 0;  // degrees per meter
};

/** The errors of all stretches and their statistics; the benchmark ranks by the means. */
struct DriftResult {
    std::vector<DriftError> errors;
    Statistics translation_percent, rotation_deg_m;
    std::vector<double> lengths_m;  // that the way is long enough for
    double scale = 1;               // that the positions were multiplied by
    std::size_t matched_poses = 0, estimate_poses = 0;
};

/** The odometry benchmark's definition (Geiger, Lenz and Urtasun, "Are we ready for autonomous
 *  driving? The KITTI vision benchmark suite", CVPR 2012): from every pose to the first one that is
 *  farther along the true way by each length; the errors are divided by the length.
 *  \throws Error when fewer than two poses match or the way is shorter than all lengths */
DriftResult evaluateDrift(const Trajectory& estimate, const Trajectory& truth,
                          const DriftOptions& options = {});

}  // namespace rgbd_graphslam
