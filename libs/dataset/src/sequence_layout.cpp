#include "rgbd_graphslam/dataset/sequence_layout.h"

#include <algorithm>
#include <filesystem>

#include "list_file.h"
#include "numbered_files.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

const std::vector<std::string> color_endings = {".png", ".jpg", ".jpeg"};

/** The first file of a folder, by name, that ends so; empty when there is none. */
std::string fileEndingOn(const fs::path& folder, const std::string& ending) {
    std::string first;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename();
        const bool ends = name.size() > ending.size() &&
                          name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
        if (ends && (first.empty() || name < first)) first = name;
    }
    return first;
}

/** S T S with S = diag(1, -1, 1): from axes with y up to axes with y down, on both sides. */
SE3 mirrored(const SE3& T) {
    const Eigen::Vector3d y_flipped(1, -1, 1);
    return {y_flipped.asDiagonal() * T.R * y_flipped.asDiagonal(), y_flipped.asDiagonal() * T.t};
}

Trajectory iclTruth(const std::string& folder, double rate_hz) {
    const std::string file = fileEndingOn(folder, ".gt.freiburg");
    if (file.empty()) return {};
    Trajectory truth = readTumTrajectory(fs::path(folder) / file);
    for (auto& pose : truth) pose = {pose.stamp_s / rate_hz, mirrored(pose.T_world_cam)};
    return truth;
}

RgbdSequence readIcl(const std::string& folder, double rate_hz) {
    const std::string form = "number depth/N.png number rgb/N.png";
    RgbdSequence sequence;
    forEachLine(fs::path(folder) / "associations.txt", [&](Line& line) {
        for (int i = 0; i < 2; ++i) {
            const double stamp_s = line.realNumber(form) / rate_hz;
            std::string file;
            if (!(line.words >> file)) line.refuse("too few values", form);
            const bool is_depth = file.find("depth") != std::string::npos;
            (is_depth ? sequence.depth : sequence.color).push_back({stamp_s, file});
        }
    });
    sequence.truth = iclTruth(folder, rate_hz);
    return sequence;
}

RgbdSequence readSevenScenes(const std::string& folder, double rate_hz) {
    RgbdSequence sequence;
    sequence.color = numberedFiles(folder, "", {".color.png", ".color.jpg"}, rate_hz);
    sequence.depth = numberedFiles(folder, "", {".depth.png"}, rate_hz);
    sequence.truth = readPoseFiles(folder, numberedFiles(folder, "", {".pose.txt"}, rate_hz));
    sequence.no_reading = 65535;
    return sequence;
}

RgbdSequence readRealSense(const std::string& folder, double rate_hz) {
    RgbdSequence sequence;
    sequence.color = numberedFiles(folder, "color", color_endings, rate_hz);
    sequence.depth = numberedFiles(folder, "depth", {".png"}, rate_hz);
    for (const std::string poses : {"poses", "pose"}) {
        if (!fs::is_directory(fs::path(folder) / poses)) continue;
        sequence.truth = readPoseFiles(folder, numberedFiles(folder, poses, {".txt"}, rate_hz));
    }
    const fs::path truth = fs::path(folder) / "groundtruth.txt";
    if (sequence.truth.empty() && fs::exists(truth)) sequence.truth = readTumTrajectory(truth);
    return sequence;
}

RgbdSequence readByLayout(const std::string& folder, SequenceLayout layout, double rate_hz) {
    switch (layout) {
        case SequenceLayout::Icl:
            return readIcl(folder, rate_hz);
        case SequenceLayout::SevenScenes:
            return readSevenScenes(folder, rate_hz);
        case SequenceLayout::RealSense:
            return readRealSense(folder, rate_hz);
        default:
            return readTumSequence(folder);
    }
}

}  // namespace

const std::vector<std::string>& layoutNames() {
    static const std::vector<std::string> names = {"tum",  "icl",   "7-scenes",
                                                   "bonn", "eth3d", "realsense"};
    return names;
}

SequenceLayout layoutByName(const std::string& name) {
    const auto& names = layoutNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw Error("there is no layout '" + name + "'", "see --help");
    return static_cast<SequenceLayout>(found - names.begin());
}

std::optional<SequenceLayout> layoutOf(const std::string& folder) {
    const fs::path path(folder);
    const auto has = [&](const char* name) { return fs::exists(path / name); };
    if (!fs::is_directory(path)) return std::nullopt;
    if (has("rgb.txt") && has("depth.txt")) {
        const std::string name = fs::weakly_canonical(path).filename();
        if (has("calibration.txt")) return SequenceLayout::Eth3d;
        return name.find("bonn") == std::string::npos ? SequenceLayout::Tum : SequenceLayout::Bonn;
    }
    if (has("associations.txt")) return SequenceLayout::Icl;
    if (!fileEndingOn(path, ".depth.png").empty()) return SequenceLayout::SevenScenes;
    if (has("color") && has("depth")) return SequenceLayout::RealSense;
    return std::nullopt;
}

SequenceLayout detectLayout(const std::string& folder) {
    checkSequenceFolder(folder);
    const auto layout = layoutOf(folder);
    const bool has_a_list =
        fs::exists(fs::path(folder) / "rgb.txt") || fs::exists(fs::path(folder) / "depth.txt");
    if (!layout && has_a_list) return SequenceLayout::Tum;
    if (!layout) {
        throw Error("'" + folder +
                        "' has no rgb.txt and depth.txt, no associations.txt, no color/ and depth/ "
                        "and no frame-000000.depth.png",
                    "give the folder of a sequence");
    }
    return *layout;
}

RgbdSequence readSequence(const std::string& folder, SequenceLayout layout, double rate_hz) {
    checkSequenceFolder(folder);
    const auto detected = layoutOf(folder);
    const bool lists = layout == SequenceLayout::Tum || layout == SequenceLayout::Bonn ||
                       layout == SequenceLayout::Eth3d;
    if (!lists && detected != layout) {
        throw Error("'" + folder + "' is not laid out as --layout " +
                        layoutNames()[static_cast<std::size_t>(layout)],
                    "leave --layout away to have it detected");
    }
    RgbdSequence sequence = readByLayout(folder, layout, rate_hz);
    sequence.folder = folder;
    return sequence;
}

}  // namespace rgbd_graphslam
