#include "rgbd_graphslam/dataset/tum_sequence.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

/** A line of a list that is no comment. */
struct Line {
    std::string path;
    int number;
    std::istringstream words;

    [[noreturn]] void refuse(const std::string& why, const std::string& form) const {
        throw Error(path + ":" + std::to_string(number) + ": " + why,
                    "each line must be '" + form + "'");
    }

    double realNumber(const std::string& form) {
        std::string word;
        if (!(words >> word)) refuse("too few values", form);
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (*end || !std::isfinite(value)) refuse("'" + word + "' is no number", form);
        return value;
    }

    /** The rest of the line without blanks around it. */
    std::string rest() {
        std::string text;
        std::getline(words >> std::ws, text);
        text.erase(text.find_last_not_of(" \t\r") + 1);
        return text;
    }
};

void forEachLine(const std::string& path, const std::function<void(Line&)>& use) {
    std::ifstream in(path);
    if (!in) throw Error("cannot read '" + path + "'", "check permissions");
    std::string text;
    for (int number = 1; std::getline(in, text); ++number) {
        text.erase(std::min(text.find('#'), text.size()));
        std::replace_if(
            text.begin(), text.end(), [](char c) { return c == ',' || c == '\t' || c == '\r'; },
            ' ');
        if (text.find_first_not_of(' ') == std::string::npos) continue;
        Line line{path, number, std::istringstream(text)};
        use(line);
    }
}

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

void checkLayout(const fs::path& folder) {
    const std::string name = folder.string();
    if (!fs::exists(folder)) throw Error("there is no folder '" + name + "'", "check the name");
    if (!fs::is_directory(folder)) {
        throw Error("'" + name + "' is not a folder", "give the folder that holds rgb.txt");
    }
    if (fs::is_empty(folder)) {
        throw Error("the folder '" + name + "' is empty", "unpack the sequence into it");
    }
    for (const char* list : {"rgb.txt", "depth.txt"}) {
        if (!fs::exists(folder / list)) {
            throw Error(
                "'" + name + "' has no " + list,
                "give the folder of a TUM RGB-D sequence, which holds rgb.txt and depth.txt");
        }
    }
}

}  // namespace

TumSequence readTumSequence(const std::string& folder) {
    const fs::path path(folder);
    checkLayout(path);
    TumSequence sequence;
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

StampOrder stampOrder(const std::vector<ListedImage>& images) {
    StampOrder order;
    std::set<double> seen;
    for (std::size_t i = 0; i < images.size(); ++i) {
        if (i > 0 && images[i].stamp_s < images[i - 1].stamp_s) ++order.backwards;
        if (!seen.insert(images[i].stamp_s).second) ++order.repeated;
    }
    return order;
}

}  // namespace rgbd_graphslam
