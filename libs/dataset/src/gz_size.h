/** What a gz file says of itself. */
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace rgbd_graphslam {

/** Unpacked size modulo 2^32, the last word of a gz file (RFC 1952); nothing when the file is no gz
 *  file. A file that was cut off ends in another number. */
std::optional<std::uint32_t> gzSize(const std::string& path);

}  // namespace rgbd_graphslam
