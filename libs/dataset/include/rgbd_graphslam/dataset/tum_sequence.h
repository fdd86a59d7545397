/** Folders in the layout of the TUM RGB-D benchmark. */
#pragma once
#include <string>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Reads rgb.txt and depth.txt (`stamp file`), and where present groundtruth.txt (`stamp tx ty tz
 *  qx qy qz qw`), accelerometer.txt (`stamp ax ay az`), gyroscope.txt (`stamp wx wy wz`) and
 *  odometry.txt (`stamp x y theta`).
 *  \throws Error when the folder or a list is missing or empty, or naming file and line that do
 *          not have this form */
RgbdSequence readTumSequence(const std::string& folder);

}  // namespace rgbd_graphslam
