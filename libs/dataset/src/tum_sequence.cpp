#include "rgbd_graphslam/dataset/tum_sequence.h"

#include <filesystem>

#include "list_file.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

std::vector<ListedImage> readImageList(const std::string& path) {
    const std::string form = "stamp file";
    std::vector<ListedImage> images;
    forEachLine(path, [&](Line& line) {
        const double stamp = line.realNumber(form);
        images.push_back({stamp, line.rest()});
        if (images.back().file.empty()) line.refuse("no file name", form);
    });
    if (images.empty()) throw Error("'" + path + "' lists no image", "fetch the sequence again");
    return images;
}

std::vector<StampedVector> readVectors(const std::string& path, const std::string& form) {
    std::vector<StampedVector> result;
    if (!fs::exists(path)) return result;
    forEachLine(path, [&](Line& line) {
        StampedVector sample;
        sample.stamp_s = line.realNumber(form);
        for (int i = 0; i < 3; ++i) sample.value[i] = line.realNumber(form);
        if (!line.rest().empty()) line.refuse("too many values", form);
        result.push_back(sample);
    });
    return result;
}

void checkLists(const fs::path& folder) {
    for (const char* list : {"rgb.txt", "depth.txt"}) {
        if (!fs::exists(folder / list)) {
            throw Error(
                "'" + folder.string() + "' has no " + list,
                "give the folder of a TUM RGB-D sequence, which holds rgb.txt and depth.txt");
        }
    }
}

}  // namespace

RgbdSequence readTumSequence(const std::string& folder) {
    const fs::path path(folder);
    checkSequenceFolder(folder);
    checkLists(path);
    RgbdSequence sequence;
    sequence.folder = folder;
    sequence.color = readImageList(path / "rgb.txt");
    sequence.depth = readImageList(path / "depth.txt");
    if (fs::exists(path / "groundtruth.txt")) {
        sequence.truth = readTumTrajectory(path / "groundtruth.txt");
    }
    sequence.acceleration = readVectors(path / "accelerometer.txt", "stamp ax ay az");
    sequence.angular_velocity = readVectors(path / "gyroscope.txt", "stamp wx wy wz");
    sequence.odometry = readVectors(path / "odometry.txt", "stamp x y theta");
    return sequence;
}

}  // namespace rgbd_graphslam
