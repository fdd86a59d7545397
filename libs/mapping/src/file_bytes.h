/** Whole files in memory. */
#pragma once
#include <cstddef>
#include <string>

namespace rgbd_graphslam {

/** \throws Error naming the file when it cannot be written whole */
void writeBytes(const std::string& path, const void* bytes, std::size_t size);

/** \throws Error naming the file when it cannot be read */
std::string readBytes(const std::string& path);

}  // namespace rgbd_graphslam
