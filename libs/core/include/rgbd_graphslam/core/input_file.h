/** Files that a user names, before they are read. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** A stream opens a folder without complaint and then reads it as an empty file: settings would
 *  silently be the defaults, and a list would have no lines.
 *  \param kind what the file should be, with its article: "an ini file"
 *  \throws Error naming `path` when it is a folder */
void refuseFolder(const std::string& path, const std::string& kind);

/** \return the whole file
 *  \param kind as above
 *  \param remedy what to give instead
 *  \throws Error when it is a folder, cannot be read or is no text (zero bytes, other control
 *  characters), whose bytes do not belong on a terminal */
std::string readTextFile(const std::string& path, const std::string& kind,
                         const std::string& remedy);

}  // namespace rgbd_graphslam
