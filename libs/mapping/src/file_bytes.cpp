#include "file_bytes.h"

#include <fstream>
#include <sstream>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

void writeBytes(const std::string& path, const void* bytes, std::size_t size) {
    writeAtomically(path, [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
        out.close();
        return out.good();
    });
}

std::string readBytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream bytes;
    if (in.good() && in.peek() != std::ifstream::traits_type::eof()) bytes << in.rdbuf();
    if (!in.is_open() || in.bad() || bytes.fail())
        throw Error("cannot read '" + path + "'", "check the name");
    return bytes.str();
}

}  // namespace rgbd_graphslam
