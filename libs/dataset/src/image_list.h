/** Lists of image files with their stamps, as TUM's rgb.txt. */
#pragma once
#include <set>
#include <string>
#include <vector>

#include "list_file.h"
#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** The file a list's entry speaks of, relative to `folder`: as written where there is such a file;
 *  otherwise without quotes, with slashes for backslashes, or without further columns, whichever
 *  leads to a file; as written when none does.
 *  \param what_was_done gets a line for the user when the entry is not taken as written */
std::string listedFile(const std::string& folder, const std::string& entry,
                       std::set<std::string>& what_was_done);

/** Reads `stamp file` lines of `folder`/`name`.
 *  \throws Error naming file and line that do not have this form, or when no image is listed */
std::vector<ListedImage> readImageList(const std::string& folder, const std::string& name,
                                       std::vector<std::string>& notes);

/** Reads accelerometer.txt, gyroscope.txt, odometry.txt, scans.txt and groundtruth.txt, where
 *  present.
 *  \throws Error naming file and line that do not have their form */
void readMotionFiles(const std::string& folder, RgbdSequence& sequence);

/** What messages call the sequence's two lists of images. */
struct ImageListNames {
    const char *color, *depth;
};

/** Turns all stamps to seconds: images by magnitude and step, the other lists so that they overlap
 *  the images. Says so in the sequence's notes.
 *  \param images_in_seconds color and depth are already
 *  \throws Error naming the list with a stamp that is no time in any unit */
void unifyStamps(RgbdSequence& sequence, bool images_in_seconds = false,
                 const ImageListNames& names = {"the color images", "the depth images"});

}  // namespace rgbd_graphslam
