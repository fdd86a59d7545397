#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "file_bytes.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"

namespace rgbd_graphslam {
namespace {

// Probabilities of being occupied. A reader takes the gray of unknown for 50 / 255 = 0.19608, which
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

/** A gz file's bytes; empty when that fails. MRPT's own function goes through a file in /tmp whose
 *  name processes that run at a time may share, and then mixes up what they write. */
std::vector<std::uint8_t> packedAsGz(const std::vector<std::uint8_t>& plain) {
    constexpr int fast = 1, gz_with_largest_window = 15 + 16, default_memory = 8;
    constexpr std::size_t most_at_a_time = 1 << 30;
    z_stream stream{};
    if (deflateInit2(&stream, fast, Z_DEFLATED, gz_with_largest_window, default_memory,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
        return {};
    }
    std::vector<std::uint8_t> packed;
    std::vector<std::uint8_t> block(1 << 18);
    int status = Z_OK;
    for (std::size_t at = 0; status == Z_OK;) {
        if (stream.avail_in == 0) {
            stream.next_in = const_cast<std::uint8_t*>(plain.data() + at);
            stream.avail_in = static_cast<uInt>(std::min(most_at_a_time, plain.size() - at));
            at += stream.avail_in;
        }
        stream.next_out = block.data();
        stream.avail_out = static_cast<uInt>(block.size());
        status = deflate(&stream, at == plain.size() ? Z_FINISH : Z_NO_FLUSH);
        packed.insert(packed.end(), block.data(), stream.next_out);
    }
    deflateEnd(&stream);
    return status == Z_STREAM_END ? packed : std::vector<std::uint8_t>{};
}

}  // namespace

void saveMrptObject(const std::string& path, const mrpt::serialization::CSerializable& object) {
    std::vector<std::uint8_t> plain;
    mrpt::serialization::ObjectToOctetVector(&object, plain);
    const auto packed = packedAsGz(plain);
    if (plain.empty() || packed.empty()) {
        throw Error("cannot pack the contents of '" + path + "'", "free some memory");
    }
    writeBytes(path, packed.data(), packed.size());
}

mrpt::maps::COccupancyGridMap2D loadGridMap(const std::string& path) {
    if (!std::filesystem::is_regular_file(path))
        throw Error("'" + path + "' is missing", "give the output folder of rgbd-slam or rgbd-map");
    mrpt::maps::COccupancyGridMap2D grid;
    try {
        mrpt::io::CFileGZInputStream file(path);
        mrpt::serialization::archiveFrom(file) >> grid;
    } catch (const std::exception&) {
        throw Error("'" + path + "' is cut off or no grid map", "make it again with rgbd-map");
    }
    return grid;
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
