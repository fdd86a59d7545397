/** A run against the ground truth of its rawlog. */
#pragma once
#include <optional>

#include "rgbd_graphslam/evaluation/ate.h"

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

}  // namespace rgbd_graphslam
