/** Images and poses whose names are all that tells when they were taken. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** The files of `folder`/`subfolder` whose names end as one of `endings`, in order of time. A name
 *  that is a number with decimals is a stamp in seconds; otherwise its last group of digits is a
 *  frame's number, taken at number / rate_hz. Names are relative to `folder`.
 *  \throws Error for a name without a number */
std::vector<ListedImage> numberedFiles(const std::string& folder, const std::string& subfolder,
                                       const std::vector<std::string>& endings, double rate_hz);

/** Poses in files of 4x4 matrices, row by row, camera to world. Matrices with infinite numbers, as
 *  recorders write for frames they could not place, are left out.
 *  \throws Error naming the file for anything else */
Trajectory readPoseFiles(const std::string& folder, const std::vector<ListedImage>& files);

}  // namespace rgbd_graphslam
