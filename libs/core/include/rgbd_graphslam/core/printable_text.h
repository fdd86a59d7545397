/** Text from outside made fit for a terminal and a log. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** One line of printable text: control bytes, line ends and bytes that are no UTF-8 become '?', and
 *  what is longer than `most_bytes` is cut off with "...". Names of files in any language stay. */
std::string printableLine(const std::string& text, std::size_t most_bytes = 1000);

}  // namespace rgbd_graphslam
