#include <mrpt/io/zip.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CSerializable.h>

#include <cstdio>
#include <opencv2/imgcodecs.hpp>

#include "file_bytes.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"

namespace rgbd_graphslam {
namespace {

// Probabilities of being occupied. A reader takes the grey of unknown for 50 / 255 = 0.19608, which
// must not be below the threshold of free space.
constexpr float occupied_threshold = 0.65f, free_threshold = 0.196f;
constexpr int ros_occupied = 0, ros_unknown = 205, ros_free = 254;

int rosShade(float probability_free) {
    if (1 - probability_free > occupied_threshold) return ros_occupied;
    return 1 - probability_free < free_threshold ? ros_free : ros_unknown;
}

std::string rosYaml(const std::string& image, const mrpt::maps::COccupancyGridMap2D& grid) {
    char text[512];
    std::snprintf(
        text, sizeof(text),
        "image: %s\nmode: trinary\nresolution: %.6g\norigin: [%.6g, %.6g, 0.0]\nnegate: 0\n"
        "occupied_thresh: %.2f\nfree_thresh: %.3f\n",
        image.c_str(), grid.getResolution(), grid.getXMin(), grid.getYMin(), occupied_threshold,
        free_threshold);
    return text;
}

}  // namespace

void saveMrptObject(const std::string& path, const mrpt::serialization::CSerializable& object) {
    constexpr int fast = 1;
    std::vector<std::uint8_t> plain, packed;
    mrpt::serialization::ObjectToOctetVector(&object, plain);
    if (plain.empty() || !mrpt::io::zip::compress_gz_data_block(plain, packed, fast)) {
        throw Error("cannot pack the contents of '" + path + "'", "free some memory");
    }
    writeBytes(path, packed.data(), packed.size());
}

void saveRosGrid(const std::string& stem, const mrpt::maps::COccupancyGridMap2D& grid) {
    const auto width = static_cast<int>(grid.getSizeX()),
               height = static_cast<int>(grid.getSizeY());
    cv::Mat1b image(height, width);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) image(height - 1 - y, x) = rosShade(grid.getCell(x, y));
    }
    writeAtomically(stem + ".png",
                    [&](const std::string& temporary) { return cv::imwrite(temporary, image); });
    const std::string name = stem.substr(stem.find_last_of('/') + 1) + ".png";
    writeTextAtomically(stem + ".yaml", rosYaml(name, grid));
}

}  // namespace rgbd_graphslam
