/** Rawlog entries other than frames. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <vector>

#include "rgbd_graphslam/dataset/sequence_import.h"

namespace rgbd_graphslam {

/** In order of time. */
using SensorEntries = std::vector<mrpt::obs::CObservation::Ptr>;

/** Ground truth, IMU and odometry of a sequence; counted in `report`. */
SensorEntries sensorEntries(const RgbdSequence& sequence, const CameraSetup& setup,
                            ImportReport& report);

}  // namespace rgbd_graphslam
