/** A run against the ground truth of its rawlog. */
#pragma once
#include <optional>

#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/metrics/ate.h"

namespace rgbd_graphslam {

struct TruthComparison {
    AteResult ate;
    /** The true pose at the stamp of each pose of the estimate, interpolated, moved to where the
     * two trajectories fit best, in the estimate's world. Gaps of the truth leave gaps. */
    Trajectory truth;
};

/** Nothing, with a warning unless there is no truth at all, where too few poses match. */
std::optional<TruthComparison> compareWithTruth(const Trajectory& estimate,
                                                const Trajectory& truth);

/** How far the measured place of an edge's later camera in the earlier one is from the true place,
 *  in m. Only relative poses count, so the truth may be in any world.
 *  \param from_s stamp of the edge's first keyframe
 *  \param to_s stamp of its second
 *  \param truth poses of the camera
 *  \returns nothing where the truth lacks one of the two */
std::optional<double> edgeErrorM(const PoseEdge& edge, double from_s, double to_s,
                                 const Trajectory& truth);

}  // namespace rgbd_graphslam
