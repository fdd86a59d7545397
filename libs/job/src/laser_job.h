/** Mapping by a 2-D laser scanner. */
#pragma once
#include "cameraless_run.h"

namespace rgbd_graphslam {

/** Runs LaserSlam over the scans.
 *  \throws Error when the scanner is mounted so that its scans are no plan, or has no readings */
void mapByLaser(const SensorLog& log, CameralessRun& run);

}  // namespace rgbd_graphslam
