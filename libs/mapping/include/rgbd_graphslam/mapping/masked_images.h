/** Keyframe images without what moves by itself. */
#pragma once
#include <memory>
#include <string>
#include <utility>

#include "rgbd_graphslam/mapping/keyframe_images.h"

namespace rgbd_graphslam {

/** Takes the depth of some classes out of the images of another store, by the label images that
 * come before them. */
class MaskedImages final : public KeyframeImages {
  public:
    /** \param camera_label of the sensor; empty = that of the label images
     *  \param classes names separated by spaces */
    MaskedImages(std::unique_ptr<KeyframeImages> images, std::string camera_label,
                 std::string classes)
        : images_(std::move(images)),
          camera_label_(std::move(camera_label)),
          classes_(std::move(classes)) {}

    std::size_t forEach(const Trajectory& keyframes, const std::string& label,
                        const Consume& consume, const Note& note = {}) const override;

  private:
    std::unique_ptr<KeyframeImages> images_;
    std::string camera_label_, classes_;
};

}  // namespace rgbd_graphslam
