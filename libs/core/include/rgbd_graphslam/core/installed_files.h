/** Where the other files of this installation are. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** A program of ours, beside the running one. */
std::string siblingProgram(const std::string& name);

/** A shipped ini file, e.g. "default.ini".
 *  \throws Error when the installation lacks it */
std::string shippedIni(const std::string& name);

}  // namespace rgbd_graphslam
