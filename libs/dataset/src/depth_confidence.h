/** Depth images that come with a confidence for each reading, as phones write them. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Sets the readings without confidence to 0, where the sequence has a confidence_folder.
 *  \param depth_file relative to the sequence's folder
 *  \param depth CV_16UC1
 *  \return what is wrong with the confidence image; empty when nothing is */
std::string dropUnconfident(const RgbdSequence& sequence, const std::string& depth_file,
                            cv::Mat& depth);

}  // namespace rgbd_graphslam
