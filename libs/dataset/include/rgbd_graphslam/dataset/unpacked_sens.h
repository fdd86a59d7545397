/** ScanNet's recordings. */
#pragma once
#include <string>

#include "rgbd_graphslam/core/temporary_folder.h"
#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Whether a path names a file with the ending .sens. */
bool isSens(const std::string& path);

/** A `.sens` file (version 4) unpacked into a temporary folder that goes when this object goes:
 *  color as the JPEG or PNG bytes that are in it, depth (raw or zlib) as 16-bit PNG, both cameras'
 *  intrinsics, the poses in it as ground truth. One frame is in memory at a time. */
class UnpackedSens {
  public:
    /** \param scratch folder to unpack in; needs room for all images
     *  \param rate_hz frames per second where the file has no timestamps
     *  \throws Error naming the frame when the file is damaged or cut off, or of a version or
     *          compression that is not read */
    UnpackedSens(const std::string& sens, const std::string& scratch, double rate_hz);

    const RgbdSequence& sequence() const { return sequence_; }

  private:
    TemporaryFolder folder_;
    RgbdSequence sequence_;
};

}  // namespace rgbd_graphslam
