/** Where EuRoC and TUM-VI say what their sensors are like. */
#pragma once
#include <mrpt/img/TCamera.h>

#include <string>
#include <utility>

#include "rgbd_graphslam/dataset/stereo_sequence.h"

namespace rgbd_graphslam {

/** Camera and its pose on the body, of a `sensor.yaml`: T_BS, resolution, intrinsics and a
 * distortion that is radial-tangential or equidistant (Kannala-Brandt). \throws Error naming the
 * file and what is missing or cannot be right */
std::pair<mrpt::img::TCamera, SE3> readEurocCamera(const std::string& path);

/** T_BS of another sensor's `sensor.yaml`; identity where there is no such file. */
SE3 readEurocPose(const std::string& path);

/** Both cameras of Kalibr's camchain: poses from T_cam_imu, the second's also from T_cn_cnm1; the
 * body is the IMU. */
StereoCalibration readCamchain(const std::string& path);

}  // namespace rgbd_graphslam
