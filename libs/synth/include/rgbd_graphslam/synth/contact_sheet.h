/** One picture that shows what sequences look like. */
#pragma once
#include <string>
#include <vector>

namespace rgbd_graphslam::synth {

/** Writes a row of color pictures, evenly spread over time, and the last one's depth for each
 *  sequence folder, with its name; its mask, too, where all folders have masks.
 *  \param path of the JPEG or PNG
 *  \throws Error when a folder holds no pictures */
void writeContactSheet(const std::vector<std::string>& folders, const std::string& path);

}  // namespace rgbd_graphslam::synth
