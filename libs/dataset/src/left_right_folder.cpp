/** Stereo images in left/ and right/. */
#include "image_folders.h"
#include "image_list.h"
#include "numbered_files.h"
#include "rgbd_graphslam/core/error.h"
#include "stereo_layouts.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;

namespace {

StereoCalibration calibrationIn(const fs::path& folder) {
    const fs::path camera = folder / "camera.ini";
    if (!fs::exists(camera)) {
        throw Error("'" + folder.string() + "' has no camera.ini",
                    "give both cameras with --camera, see doc/file-formats.md");
    }
    return readStereoCameraFile(camera);
}

}  // namespace

bool isLeftRightFolder(const fs::path& folder) {
    return fs::is_directory(folder / "left") && fs::is_directory(folder / "right");
}

StereoSequence readLeftRightFolder(const fs::path& folder, double rate_hz,
                                   const StereoCalibration* given) {
    StereoSequence sequence;
    RgbdSequence& motion = sequence.motion;
    const bool by_lists = fs::exists(folder / "left.txt") && fs::exists(folder / "right.txt");
    motion.notes.emplace_back("left/ and right/");
    if (by_lists) {
        motion.color = readImageList(folder, "left.txt", motion.notes);
        motion.depth = readImageList(folder, "right.txt", motion.notes);
    } else {
        const auto left = filesByNumber(folder, "left", color_endings);
        const NumberMeaning meaning = meaningOf(left, rate_hz);
        motion.notes.push_back(meaning.said);
        motion.color = stamped(left, meaning);
        motion.depth = stamped(filesByNumber(folder, "right", color_endings), meaning);
    }
    readMotionFiles(folder, motion);
    unifyStamps(motion, !by_lists, {"the left images", "the right images"});
    sequence.left = std::move(motion.color);
    sequence.right = std::move(motion.depth);
    motion.color.clear();
    motion.depth.clear();
    sequence.calibration = given ? *given : calibrationIn(folder);
    return sequence;
}

}  // namespace rgbd_graphslam
