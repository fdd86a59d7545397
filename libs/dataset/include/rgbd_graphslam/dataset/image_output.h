/** Images written to files. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** As cv::imwrite, with the same bytes, but the image is encoded in memory first: on a full disk
 *  the encoders of libpng and libjpeg print complaints of their own, and the reason is lost.
 *  \param path its extension decides on the format
 *  \param parameters those of cv::imwrite
 *  \return false when the file cannot be written; `errno` then says why */
bool writeImageFile(const std::string& path, const cv::Mat& image,
                    const std::vector<int>& parameters = {});

}  // namespace rgbd_graphslam
