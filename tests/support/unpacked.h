/** What is inside gz files. */
#pragma once
#include <mrpt/io/CFileGZInputStream.h>

#include <string>

namespace rgbd_graphslam {

/** \return the contents of a file that may be packed with gz */
inline std::string unpacked(const std::string& file) {
    mrpt::io::CFileGZInputStream in(file);
    std::string bytes, block(1 << 16, '\0');
    while (const std::size_t read = in.Read(block.data(), block.size())) {
        bytes.append(block, 0, read);
    }
    return bytes;
}

}  // namespace rgbd_graphslam
