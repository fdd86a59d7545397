/** Label images that come with a recording. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "rgbd_graphslam/dataset/label_set.h"

namespace rgbd_graphslam {

/** Class numbers of pixels, from a folder beside the color images. */
class LabelImages {
  public:
    /** \param folder of the sequence: its `label/` holds a PNG with the name of each color image
     *         that is labeled, `labels.ini` the names of its values
     *  \throws Error when labels.ini cannot be used */
    explicit LabelImages(const std::string& folder);

    bool empty() const { return folder_.empty(); }
    const LabelSet& names() const { return names_; }

    /** CV_16UC1, 0 = no class; empty where the image has none.
     *  \throws Error when the file is damaged, no label image or not of the color image's size */
    cv::Mat of(const std::string& color_file, const cv::Size& size) const;

  private:
    std::string folder_;  // empty where there is none
    LabelSet names_;
};

}  // namespace rgbd_graphslam
