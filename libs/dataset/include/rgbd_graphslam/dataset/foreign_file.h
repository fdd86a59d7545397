/** Recordings that are not read, told by their first bytes. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** What a file that is given as a recording is, and what converts it.
 *  \throws Error always, in one line */
[[noreturn]] void refuseForeignFile(const std::string& path);

}  // namespace rgbd_graphslam
