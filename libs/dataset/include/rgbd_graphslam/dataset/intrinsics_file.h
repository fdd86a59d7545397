/** Calibrations in other programs' formats. */
#pragma once
#include <optional>
#include <string>

#include "rgbd_graphslam/dataset/camera_file.h"

namespace rgbd_graphslam {

/** Reads a calibration by its ending: `.json` of librealsense (width, height, fx, fy, ppx, ppy,
 *  model, coeffs), Open3D and Azure Kinect (width, height, intrinsic_matrix, also inside
 *  PinholeCameraParameters and trajectories) or with fx, fy, cx, cy or K; `.yaml` and `.yml` of ROS
 *  (camera_info), Kalibr and EuRoC; anything else as readCameraFile(). Calibrations of several
 *  cameras: the one called color or rgb, else the first. Depth units are those of a key
 *  depth_scale, depth_units or scale, else millimeters are assumed.
 *  \throws Error naming the file when it cannot be read, lacks something, or is of a lens model
 *          other than Brown's of up to 8 coefficients and Kannala and Brandt's */
CameraSetup readCalibration(const std::string& path);

/** The calibration of a folder, in a file of one of the usual names. */
std::optional<CameraSetup> calibrationIn(const std::string& folder);

}  // namespace rgbd_graphslam
