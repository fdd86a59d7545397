/** Which images of two lists belong together. */
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "rgbd_graphslam/dataset/sequence_import.h"

namespace rgbd_graphslam {

/** The images of one camera. */
struct ImageStream {
    /** For messages, such as "color". */
    std::string name;
    const std::vector<ListedImage>& images;
    ImageTally& tally;
    /** Added to the stamps, s. */
    double offset_s = 0;
};

using ImagePair = std::pair<ListedImage, ListedImage>;

/** Pairs of images that exist, in order of time; fills the streams' tallies.
 *  \param folder that the files are relative to
 *  \throws Error when there is none, when more than half are lost and options.allow_loss is not
 * set, or when a listed file is missing and options.strict is set */
std::vector<ImagePair> pairUp(const std::string& folder, const ImageStream& first,
                              const ImageStream& second, const ImportOptions& options);

/** How many images of a stream were listed and left over, and why: a line. */
std::string tallyText(const std::string& name, const std::string& other, const ImageTally& tally);

struct FramePair {
    ListedImage color, depth;
};

/** Color with depth; fills the tallies of `report`. \throws Error as above */
std::vector<FramePair> pairUp(const RgbdSequence& sequence, const ImportOptions& options,
                              ImportReport& report);

}  // namespace rgbd_graphslam
