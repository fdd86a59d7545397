/** What of a run had happened by a moment. */
#pragma once
#include <cstddef>
#include <optional>

#include "rgbd_graphslam/viewer/run_data.h"

namespace rgbd_graphslam {

/** Lengths of the prefixes of a run's lists. */
struct ReplayState {
    std::size_t poses = 0, keyframes = 0, loops = 0, covisibility = 0, frames = 0;
};

/** \param stamp_s everything up to and including it */
ReplayState replayAt(const RunData& run, double stamp_s);

/** First and last stamp of the trajectory; zeros when it is empty. */
std::pair<double, double> timeSpan(const RunData& run);

/** poseAt() with the first or last pose beyond the ends.
 *  \return nothing when the trajectory is empty */
std::optional<SE3> poseNear(const Trajectory& trajectory, double stamp_s);

}  // namespace rgbd_graphslam
