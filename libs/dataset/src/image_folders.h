/** A folder of color and one of depth images, without lists. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

extern const std::vector<std::string> color_endings, depth_endings;

/** The first subfolder of `folder` that is named as one for color images are: color, rgb, image,
 *  images; empty when there is none. */
std::string colorFolderIn(const std::string& folder);

/** Likewise of depth images. */
std::string depthFolderIn(const std::string& folder);

/** Images by the numbers in their names, see meaningOf(); poses/ or pose/ with 4x4 matrices; motion
 *  sensors and ground truth as in TUM's layout.
 *  \throws Error when a folder has no image, or for a name without a number */
RgbdSequence readImageFolders(const std::string& folder, double rate_hz);

}  // namespace rgbd_graphslam
