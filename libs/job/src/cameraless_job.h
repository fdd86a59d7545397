/** Jobs on recordings without a camera. */
#pragma once
#include <optional>

#include "rgbd_graphslam/job/slam_job.h"

namespace rgbd_graphslam {

/** Runs the job by the sensors that there are. \return nothing where the rawlog has a camera, or
 *  nothing to go by
 *  \throws Error when the job asks for what needs a camera, or the sensors make no map */
std::optional<JobReport> runWithoutCamera(const SlamJob& job);

}  // namespace rgbd_graphslam
