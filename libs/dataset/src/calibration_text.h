/** Calibrations as text. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** All of a file. \throws Error when it cannot be read or is too large for a calibration */
std::string calibrationText(const std::string& path);

}  // namespace rgbd_graphslam
