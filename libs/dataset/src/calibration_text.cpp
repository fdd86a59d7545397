#include "calibration_text.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/input_file.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;

std::string calibrationText(const std::string& path) {
    constexpr std::uintmax_t most_bytes = 64 << 20;
    refuseFolder(path, "a calibration");
    std::ifstream in(path, std::ios::binary);
    std::error_code failure;
    const auto bytes = fs::file_size(path, failure);
    if (!in || failure) throw Error("cannot read the calibration '" + path + "'", "check the name");
    if (bytes > most_bytes)
        throw Error("'" + path + "' is too large for a calibration", "check it");
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace rgbd_graphslam
