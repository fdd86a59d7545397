#include "gz_size.h"

#include <array>
#include <fstream>

namespace rgbd_graphslam {

std::optional<std::uint32_t> gzSize(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::array<unsigned char, 4> bytes{};
    const auto read = [&] {
        in.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
        return in.gcount() == 4;
    };
    if (!read() || bytes[0] != 0x1f || bytes[1] != 0x8b) return std::nullopt;
    in.seekg(-4, std::ios::end);
    if (!read()) return std::nullopt;
    return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

}  // namespace rgbd_graphslam
