#include "image_folders.h"

#include <filesystem>

#include "image_list.h"
#include "numbered_files.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

std::string firstFolderOf(const std::string& folder, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (fs::is_directory(fs::path(folder) / name)) return name;
    }
    return "";
}

NumberedFiles imagesOf(const std::string& folder, const std::string& subfolder,
                       const std::vector<std::string>& endings) {
    NumberedFiles images = filesByNumber(folder, subfolder, endings);
    if (!images.files.empty()) return images;
    std::string known;
    for (const std::string& ending : endings) known += " " + ending;
    throw Error("'" + (fs::path(folder) / subfolder).string() + "' has no image",
                "files of these endings are read:" + known);
}

}  // namespace

const std::vector<std::string> color_endings = {".png", ".jpg", ".jpeg", ".webp",
                                                ".ppm", ".pgm", ".bmp"};
const std::vector<std::string> depth_endings = {".png", ".tif", ".tiff", ".pgm"};

std::string colorFolderIn(const std::string& folder) {
    return firstFolderOf(folder, {"color", "rgb", "image", "images"});
}

std::string depthFolderIn(const std::string& folder) {
    return firstFolderOf(folder, {"depth", "depths"});
}

RgbdSequence readImageFolders(const std::string& folder, double rate_hz) {
    const auto color = imagesOf(folder, colorFolderIn(folder), color_endings);
    const auto depth = imagesOf(folder, depthFolderIn(folder), depth_endings);
    const NumberMeaning meaning = meaningOf(color, rate_hz);
    RgbdSequence sequence;
    sequence.color = stamped(color, meaning);
    sequence.depth = stamped(depth, meaning);
    sequence.notes.push_back(meaning.said);
    readMotionFiles(folder, sequence);
    const std::string poses = firstFolderOf(folder, {"poses", "pose"});
    if (!poses.empty()) {
        const auto files = stamped(filesByNumber(folder, poses, {".txt"}), meaning);
        sequence.truth = readPoseFiles(folder, files);
    }
    unifyStamps(sequence, true);
    return sequence;
}

}  // namespace rgbd_graphslam
