/** How this process was called, and when. */
#pragma once
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** One line that a shell reads as these arguments; line breaks within them become blanks. */
std::string shellLine(const std::vector<std::string>& arguments);

/** This process's command line, its program without folders; empty where /proc does not tell. */
std::string commandText();

/** As people write it, to the second: "2024-05-01 14:03:59 +0200". */
std::string localTimeText();

}  // namespace rgbd_graphslam
