/** Recordings of iPhones and iPads with LiDAR. */
#pragma once
#include <string>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Whether a folder holds what Stray Scanner writes: odometry.csv, camera_matrix.csv and depth/. */
bool isStrayScanner(const std::string& folder);

/** Color from rgb/ (frames extracted from rgb.mp4), small depth in mm, confidence images, stamps
 *  from odometry.csv (`timestamp, frame, x, y, z, qx, qy, qz, qw`), the 3x3 camera_matrix.csv. The
 *  phone's own poses are an estimate and no ground truth: they are left out, which the notes say.
 *  imu.csv (`timestamp, a_x, a_y, a_z, alpha_x, alpha_y, alpha_z`) holds what iOS gives:
 * acceleration in g with gravity's sign, turned to m/s^2 as felt, and rad/s. \throws Error when the
 * frames are still a video, or naming file and line of another form */
RgbdSequence readStrayScanner(const std::string& folder);

/** Whether a folder holds an export of Record3D: rgb/, depth/ and metadata (.json) with a matrix K.
 */
bool isRecord3d(const std::string& folder);

/** Images by number at the metadata's `fps`, camera by its `K` (3x3, column by column), `w` and
 *  `h`; depth in mm.
 *  \throws Error naming what the metadata lacks */
RgbdSequence readRecord3d(const std::string& folder);

}  // namespace rgbd_graphslam
