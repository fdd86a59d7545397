#include "rgbd_graphslam/dataset/tum_sequence.h"

#include <filesystem>

#include "image_list.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

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
    sequence.color = readImageList(folder, "rgb.txt", sequence.notes);
    sequence.depth = readImageList(folder, "depth.txt", sequence.notes);
    readMotionFiles(folder, sequence);
    unifyStamps(sequence);
    return sequence;
}

}  // namespace rgbd_graphslam
