/** How good a run is, told without ground truth. */
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/mapping/surface_spread.h"
#include "rgbd_graphslam/slam/rolling_shutter.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {

/** Median and maximum over the loops. */
struct LoopResiduals {
    double median_m = 0, max_m = 0, median_deg = 0, max_deg = 0;
};

/** The largest gap that a loop closed: where tracking alone had put a keyframe against where the
 *  loop measured it. */
struct DriftBeforeLoops {
    double gap_m = 0;
    /** Way from one of the loop's keyframes to the other, m. */
    double path_m = 0;

    double share() const { return path_m > 0 ? gap_m / path_m : 0; }
};

/** Measures of quality that need no ground truth. */
struct RunQuality {
    /** Of all frames, 0 to 1. */
    double tracked = 0, recovered = 0, dead_reckoned = 0, lost = 0;
    /** Inliers of the frames that have a pose: median, and what 95 % of the frames exceed. */
    double inliers_median = 0, inliers_p05 = 0;
    /** Share of a keyframe's pixels with depth in the range that is used, the same two figures. */
    std::optional<double> depth_median, depth_p05;
    /** Nothing where too few keyframes see the same. */
    std::optional<SurfaceSpread> spread;
    /** Of the optimized map against what each loop measured; nothing without loops. */
    std::optional<LoopResiduals> loops;
    std::optional<DriftBeforeLoops> drift;
    /** Nothing where the images moved too little to tell. */
    std::optional<ReadoutTime> readout;
};

/** States and inliers of the frames. */
RunQuality frameQuality(const std::vector<TrackedFrame>& frames);

/** \param keyframes of all loops' parts, poses of the finished map; none for no loops */
std::optional<LoopResiduals> loopResiduals(const std::vector<PoseEdge>& loops,
                                           const std::vector<KeyframeView>& keyframes);

/** \param before_loops poses of all keyframes as tracking alone chained them; none for no loops
 *  \param keyframes of the map; loops across a keyframe that nothing ties to the one before closed
 *         no drift and are passed over */
std::optional<DriftBeforeLoops> driftBeforeLoops(const std::vector<PoseEdge>& loops,
                                                 const Trajectory& before_loops,
                                                 const std::vector<Keyframe>& keyframes);

/** Of rows read one after the other, with the time that takes; empty unless that is beyond doubt.
 */
std::string rollingShutterFinding(const RunQuality& quality);

/** "surfaces agree within 3.1 mm (95 %: 9.0 mm), loops within 2.2 mm, drift before loops 0.031 m
 *  (0.4 %), 512 inliers, 93 % of the pixels have depth" */
std::string qualityText(const RunQuality& quality);

}  // namespace rgbd_graphslam
