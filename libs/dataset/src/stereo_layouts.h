/** The layouts of stereo recordings, one reader each. */
#pragma once
#include <filesystem>
#include <string>

#include "rgbd_graphslam/dataset/stereo_sequence.h"

namespace rgbd_graphslam {

bool isEurocFolder(const std::filesystem::path& folder);
bool isKittiFolder(const std::filesystem::path& folder);
bool isLeftRightFolder(const std::filesystem::path& folder);

/** Each reads lists and motion. \param given calibration in place of the folder's; may be null */
StereoSequence readEurocFolder(const std::filesystem::path& folder, const StereoCalibration* given);
StereoSequence readKittiFolder(const std::filesystem::path& folder, double rate_hz,
                               const StereoCalibration* given);
StereoSequence readLeftRightFolder(const std::filesystem::path& folder, double rate_hz,
                                   const StereoCalibration* given);

}  // namespace rgbd_graphslam
