/** What trajectory formats are made of. */
#pragma once
#include <string>

#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** trajectory.txt of a run, of any kind.
 *  \throws Error naming the file when it is missing or damaged */
Trajectory readRunTrajectory(const std::string& run_folder);

/** How many frames of frames.csv have no pose; 0 without that file. */
std::size_t framesWithoutPose(const std::string& run_folder, const Trajectory& trajectory);

/** "113 poses" */
std::string poseCount(const Trajectory& trajectory);

}  // namespace rgbd_graphslam
