/** Sequence folders as different benchmarks and recorders lay them out. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** The layouts that are known. */
enum class SequenceLayout {
    /** rgb.txt and depth.txt, see tum_sequence.h. */
    Tum,
    /** ICL-NUIM, "TUM RGB-D compatible": associations.txt (`number depth/N.png number rgb/N.png`)
     *  and *.gt.freiburg. Its renderer's camera looks with y up, in a left-handed world; the truth
     *  is mirrored on reading, so that a camera with y down fits to it. */
    Icl,
    /** Microsoft 7-Scenes: frame-N.color.png, frame-N.depth.png (mm, 65535 is no reading) and
     *  frame-N.pose.txt (4x4, camera to world). Its depth is not registered to color. */
    SevenScenes,
    /** Bonn RGB-D Dynamic: as Tum, with one camera for all sequences. */
    Bonn,
    /** ETH3D SLAM: as Tum, with the camera in calibration.txt (`fx fy cx cy`). */
    Eth3d,
    /** Folders color/ and depth/ (mm), where present poses/ or pose/ with a 4x4 matrix (camera to
     *  world) for each color image, or groundtruth.txt, and Open3D's camera_intrinsic.json or
     *  another calibration, see calibrationIn(). */
    RealSense,
    /** associations.txt (or a variant of the name) with stamps: `stamp file stamp file`. */
    Associations,
    /** As RealSense, with the color images in rgb/, image/ or images/. */
    Folders,
    /** Stray Scanner on an iPhone, see phone_folders.h. */
    StrayScanner,
    /** Record3D on an iPhone, see phone_folders.h. */
    Record3d
};

/** Names of the layouts in the order of the enumeration, as they are typed. */
const std::vector<std::string>& layoutNames();

/** \throws Error for another name */
SequenceLayout layoutByName(const std::string& name);

/** The layout that the names in a folder speak of. */
std::optional<SequenceLayout> layoutOf(const std::string& folder);

/** As layoutOf; a folder with but one of TUM's two lists counts as TUM's, so that reading it names
 *  what is missing.
 *  \throws Error when there is no such folder or it is of none of the layouts */
SequenceLayout detectLayout(const std::string& folder);

/** Reads the lists of a folder.
 *  \param rate_hz frames a second, for layouts that number their images instead of stamping them: a
 *         name such as `frame-000012` is taken at 12 / rate_hz, one such as `1305031102.175304` at
 *         that time; names that are stamps in ms, us or ns are recognized
 *  \throws Error when the folder is not of that layout, or naming file and line that do not have
 *          the layout's form */
RgbdSequence readSequence(const std::string& folder, SequenceLayout layout, double rate_hz);

/** Gives a calibration that states no image size that of the sequence's first color image.
 *  \throws Error when the image cannot be read */
void completeImageSize(const RgbdSequence& sequence, Intrinsics& camera);

/** The camera that a benchmark publishes for all its sequences or puts into the sequence's folder;
 *  nothing for the TUM benchmark, whose cameras go by the names of sequences.
 *  \throws Error when a calibration in the folder cannot be read */
std::optional<CameraSetup> layoutCamera(const RgbdSequence& sequence, SequenceLayout layout);

}  // namespace rgbd_graphslam
