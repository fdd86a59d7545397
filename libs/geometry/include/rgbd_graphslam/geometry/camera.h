/** The usual name of the camera model. */
#pragma once
#include "rgbd_graphslam/geometry/camera_model.h"

namespace rgbd_graphslam {
using Camera = CameraModel;
}
