/** Wheels, IMU and GPS without a camera. */
#pragma once
#include "cameraless_run.h"

namespace rgbd_graphslam {

/** \throws Error when there are no wheels, or fewer than two usable fixes */
void fuseWithGps(const SensorLog& log, CameralessRun& run);

}  // namespace rgbd_graphslam
