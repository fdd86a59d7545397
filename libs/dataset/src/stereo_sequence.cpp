#include <optional>

#include "stereo_layouts.h"

namespace rgbd_graphslam {
namespace {

StereoSequence readByLayout(const std::string& folder, double rate_hz,
                            const StereoCalibration* given) {
    if (isEurocFolder(folder)) return readEurocFolder(folder, given);
    if (isKittiFolder(folder)) return readKittiFolder(folder, rate_hz, given);
    return readLeftRightFolder(folder, rate_hz, given);
}

}  // namespace

bool isStereoFolder(const std::string& folder) {
    return isEurocFolder(folder) || isKittiFolder(folder) || isLeftRightFolder(folder);
}

StereoSequence readStereoFolder(const std::string& folder, double rate_hz,
                                const std::string& camera_file) {
    std::optional<StereoCalibration> given;
    if (!camera_file.empty()) given = readStereoCameraFile(camera_file);
    StereoSequence sequence = readByLayout(folder, rate_hz, given ? &*given : nullptr);
    sequence.folder = sequence.motion.folder = folder;
    return sequence;
}

}  // namespace rgbd_graphslam
