/** Which color image goes with which depth image. */
#pragma once
#include <vector>

#include "rgbd_graphslam/dataset/sequence_import.h"

namespace rgbd_graphslam {

struct FramePair {
    ListedImage color, depth;
};

/** Pairs of images that exist, in order of time; fills the tallies of `report`.
 *  \throws Error when there is none, or when a listed file is missing and options.strict is set */
std::vector<FramePair> pairUp(const RgbdSequence& sequence, const ImportOptions& options,
                              ImportReport& report);

}  // namespace rgbd_graphslam
