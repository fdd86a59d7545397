/** Masks that come with a recording. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

namespace rgbd_graphslam {

/** The pixels to ignore: black in a mask for the whole recording or in one for the frame, the
 *  convention of COLMAP. */
class ImageMasks {
  public:
    /** \param folder of the sequence: its `mask/` holds a PNG with the name of each color image
     *         that has a mask of its own
     *  \param file mask for the whole recording; empty: `mask.png` of the folder, if it is there
     *  \throws Error when the file is no image */
    ImageMasks(const std::string& folder, const std::string& file);

    bool empty() const { return whole_.empty() && folder_.empty(); }

    /** CV_8UC1, 0 and 255; empty where all of the image is used.
     *  \throws Error when a mask is damaged or not of the color image's size */
    cv::Mat of(const std::string& color_file, const cv::Size& size) const;

  private:
    std::string file_, folder_;  // folder_ is empty where there is none
    cv::Mat whole_;
};

}  // namespace rgbd_graphslam
