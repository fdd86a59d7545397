/** Relative pose error: how much an estimate drifts over a given distance in time or space. */
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/metrics/estimate_options.h"
#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {

/** What the distance between the two poses of a pair is measured in; meters, radians and degrees
 *  are summed along the path of the estimate. */
enum class DeltaUnit { Seconds, Meters, Radians, Degrees, Frames };

/** Which pairs of poses are compared. */
struct RpeOptions : EstimateOptions {
    /** Pairs `delta` apart; otherwise all pairs, in which `delta` has no say. */
    bool fixed_delta = false;
    double delta = 1;
    DeltaUnit unit = DeltaUnit::Seconds;
    /** As many pairs are drawn when there are more; 0 takes all. */
    std::size_t max_pairs = 10000;
    std::uint64_t seed = 0;  // of the drawing
};

/** What the estimate's motion from one pose to another leaves of the true motion. */
struct RelativeError {
    double from_s = 0, to_s = 0;  // stamps of the estimate
    Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  // axis times angle
};

/** The errors of all pairs and their statistics. */
struct RpeResult {
    std::vector<RelativeError> errors;  // in the order the pairs were formed
    Statistics translation_m, rotation_deg;
    std::size_t matched_poses = 0;  // poses of the estimate for which there is a truth
    std::size_t estimate_poses = 0;
};

/** The definition of Sturm et al., IROS 2012, with the look-ups and figures of the benchmark's
 *  tools: each stamp of the estimate takes the nearest truth, and a pair counts when both are
 *  within twice the median interval of the truth. Of poses with the same stamp the last counts.
 *  \throws Error when fewer than two pairs are left, with the time spans of both trajectories */
RpeResult evaluateRpe(const Trajectory& estimate, const Trajectory& truth,
                      const RpeOptions& options = {});

}  // namespace rgbd_graphslam
