/** Lists that name color and depth of each frame in one line. */
#pragma once
#include <string>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** The name of the list in a folder: associations.txt or one of its variants; empty when there is
 *  none. */
std::string associationsIn(const std::string& folder);

/** Reads `stamp file stamp file` or `stamp file file` lines, color or depth first, as the folders'
 *  names in the files tell. Stamps as in image_list.h, or frame numbers, taken at number / rate_hz.
 *  \throws Error naming file and line that do not have this form */
RgbdSequence readAssociations(const std::string& folder, double rate_hz);

/** Whether the list has frame numbers instead of stamps.
 *  \throws Error as readAssociations() */
bool associationsAreNumbered(const std::string& folder);

}  // namespace rgbd_graphslam
