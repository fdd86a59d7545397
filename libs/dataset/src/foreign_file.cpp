#include "rgbd_graphslam/dataset/foreign_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <vector>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

struct ForeignFormat {
    std::size_t at;
    /** First bytes from `at` on; empty: only the ending counts. */
    std::string bytes;
    /** Empty: any. */
    std::string ending;
    const char* what;
    const char* remedy;
};

const std::vector<ForeignFormat>& foreignFormats() {
    using namespace std::string_literals;
    static const std::vector<ForeignFormat> formats = {
        {0, "\x1a\x45\xdf\xa3"s, "", "a Matroska video, as the Azure Kinect records",
         "unpack it with Open3D's azure_kinect_mkv_reader.py into color/, depth/ and "
         "intrinsic.json, and give that folder"},
        {0, "ONI\0"s, "", "an OpenNI recording",
         "convert it to a folder of images, for example with OpenNI's NiViewer, or play it into a "
         "ROS bag"},
        {0, "", ".klg", "a log of Kintinuous or ElasticFusion (.klg)",
         "convert it to a folder of images, for example with klg2png"},
        {0, "\x89HDF\r\n\x1a\n"s, "", "an HDF5 file",
         "export its images into rgb/ and depth/ (16-bit PNG) and give that folder"},
        {0, "SQLite format 3\0"s, "", "an SQLite database, as ROS 2 bags are (.db3)",
         "give the bag's folder, or convert it with rosbags-convert"},
        {0, "\x89MCAP0\r\n"s, "", "an MCAP file of ROS 2", "convert it with rosbags-convert"},
        {0, "#ROSBAG V"s, "", "a ROS 1 bag", "its name must end with .bag"},
        {4, "ftyp", "", "an MP4 or MOV video",
         "extract its frames into rgb/, beside depth/: ffmpeg -i FILE -vsync 0 rgb/%06d.png"},
        {0, "RIFF", ".avi", "an AVI video",
         "extract its frames into rgb/, beside depth/: ffmpeg -i FILE -vsync 0 rgb/%06d.png"},
        {0, "ply", ".ply", "a point cloud or mesh", "give the recording it was made from"},
        {0, "", ".r3d", "a Record3D capture (.r3d)",
         "export it in Record3D as an RGB-D image sequence with 16-bit PNG depth"},
        {0, "", ".rawlog", "a rawlog", "it needs no import: give it to rgbd-slam"},
        {0, "\x89PNG"s, "", "one PNG image", "give the folder of the sequence"},
        {0, "\xff\xd8\xff"s, "", "one JPEG image", "give the folder of the sequence"},
        {0, "Rar!", "", "a RAR archive", "unpack it and give its folder"},
        {0, "7z\xbc\xaf"s, "", "a 7z archive", "unpack it and give its folder"},
    };
    return formats;
}

std::string firstBytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw Error("cannot read '" + path + "'", "check permissions");
    std::string bytes(32, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
    return bytes;
}

std::string endingOf(const std::string& path) {
    std::string ending = fs::path(path).extension();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

}  // namespace

void refuseForeignFile(const std::string& path) {
    const std::string bytes = firstBytes(path), ending = endingOf(path);
    if (bytes.empty()) throw Error("the file '" + path + "' is empty", "fetch it again");
    for (const auto& format : foreignFormats()) {
        const bool fits = bytes.compare(std::min(format.at, bytes.size()), format.bytes.size(),
                                        format.bytes) == 0 &&
                          (format.ending.empty() || format.ending == ending);
        if (fits) throw Error("'" + path + "' is " + format.what, format.remedy);
    }
    throw Error("'" + path + "' is not a folder, nor a recording of a known format",
                "give the folder that holds the sequence, its .tgz or .zip archive, a ROS bag or "
                "a .sens file");
}

}  // namespace rgbd_graphslam
