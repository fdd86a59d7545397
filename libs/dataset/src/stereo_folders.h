/** Stereo recordings, which are recognized but not imported yet. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** \throws Error naming the layout and the number of image pairs when a folder is laid out as
 * EuRoC's (mav0/cam0, cam1) or KITTI odometry's (image_0, image_1) recordings */
void refuseStereo(const std::string& folder);

}  // namespace rgbd_graphslam
