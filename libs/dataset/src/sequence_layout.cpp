#include "rgbd_graphslam/dataset/sequence_layout.h"

#include <algorithm>
#include <filesystem>

#include "associations.h"
#include "image_folders.h"
#include "list_file.h"
#include "numbered_files.h"
#include "phone_folders.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/stereo_sequence.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

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
    RgbdSequence sequence = readAssociations(folder, rate_hz);
    const Trajectory truth = iclTruth(folder, rate_hz);
    if (!truth.empty()) sequence.truth = truth;
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

RgbdSequence readByLayout(const std::string& folder, SequenceLayout layout, double rate_hz) {
    switch (layout) {
        case SequenceLayout::Icl:
            return readIcl(folder, rate_hz);
        case SequenceLayout::SevenScenes:
            return readSevenScenes(folder, rate_hz);
        case SequenceLayout::RealSense:
        case SequenceLayout::Folders:
            return readImageFolders(folder, rate_hz);
        case SequenceLayout::Associations:
            return readAssociations(folder, rate_hz);
        case SequenceLayout::StrayScanner:
            return readStrayScanner(folder);
        case SequenceLayout::Record3d:
            return readRecord3d(folder);
        default:
            return readTumSequence(folder);
    }
}

/** ICL's images are numbered; a list that cannot be read is told of when it is read. */
SequenceLayout layoutOfAssociations(const std::string& folder) {
    if (!fileEndingOn(folder, ".gt.freiburg").empty()) return SequenceLayout::Icl;
    try {
        return associationsAreNumbered(folder) ? SequenceLayout::Icl : SequenceLayout::Associations;
    } catch (const Error&) {
        return SequenceLayout::Associations;
    }
}

/** A folder right below that holds a sequence; empty when there is none. */
std::string sequenceBelow(const std::string& folder) {
    std::string first;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string path = entry.path();
        const bool is_sequence = layoutOf(path) || isStereoFolder(path);
        if ((first.empty() || path < first) && is_sequence) first = path;
    }
    return first;
}

}  // namespace

const std::vector<std::string>& layoutNames() {
    static const std::vector<std::string> names = {
        "tum",       "icl",          "7-scenes", "bonn",          "eth3d",
        "realsense", "associations", "folders",  "stray-scanner", "record3d"};
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
    if (!associationsIn(folder).empty()) return layoutOfAssociations(folder);
    if (!fileEndingOn(path, ".depth.png").empty()) return SequenceLayout::SevenScenes;
    if (isStrayScanner(folder)) return SequenceLayout::StrayScanner;
    if (isRecord3d(folder)) return SequenceLayout::Record3d;
    const std::string color = colorFolderIn(folder), depth = depthFolderIn(folder);
    if (color.empty() || depth.empty() || has("rgb.txt") || has("depth.txt")) return std::nullopt;
    return color == "color" && depth == "depth" ? SequenceLayout::RealSense
                                                : SequenceLayout::Folders;
}

SequenceLayout detectLayout(const std::string& folder) {
    checkSequenceFolder(folder);
    const auto layout = layoutOf(folder);
    const bool has_a_list =
        fs::exists(fs::path(folder) / "rgb.txt") || fs::exists(fs::path(folder) / "depth.txt");
    if (!layout && has_a_list) return SequenceLayout::Tum;
    if (layout) return *layout;
    const std::string below = sequenceBelow(folder);
    throw Error("'" + folder +
                    "' has no rgb.txt and depth.txt, no associations.txt, no folders rgb/ or "
                    "color/ and depth/, no frame-000000.depth.png and no stereo images",
                below.empty() ? "give the folder of a sequence" : "did you mean '" + below + "'?");
}

RgbdSequence readSequence(const std::string& folder, SequenceLayout layout, double rate_hz) {
    checkSequenceFolder(folder);
    const bool by_lists = layout == SequenceLayout::Tum || layout == SequenceLayout::Bonn ||
                          layout == SequenceLayout::Eth3d;
    const bool by_associations =
        layout == SequenceLayout::Icl || layout == SequenceLayout::Associations;
    const bool fits = by_lists || (by_associations ? !associationsIn(folder).empty()
                                                   : layoutOf(folder) == layout);
    if (!fits) {
        throw Error("'" + folder + "' is not laid out as --layout " +
                        layoutNames()[static_cast<std::size_t>(layout)],
                    "leave --layout away to have it detected");
    }
    RgbdSequence sequence = readByLayout(folder, layout, rate_hz);
    sequence.folder = folder;
    return sequence;
}

}  // namespace rgbd_graphslam
