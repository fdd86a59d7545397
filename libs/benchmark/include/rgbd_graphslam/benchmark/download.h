/** Fetching files over HTTP. */
#pragma once
#include <cstddef>
#include <optional>
#include <string>

namespace rgbd_graphslam {

/** Fetches a file by HTTP or HTTPS. What has arrived stays in `path`.part and is not fetched again
 *  by the next call, where the server allows that; `path` appears when the file is whole. A file
 *  that is there already is left as it is. Shows progress.
 *  \param bytes its size, where known
 *  \throws Error when the server cannot be reached, refuses, offers another size or stops early, or
 *          when the file does not fit on the disk */
void download(const std::string& url, const std::string& path, std::optional<std::size_t> bytes);

}  // namespace rgbd_graphslam
