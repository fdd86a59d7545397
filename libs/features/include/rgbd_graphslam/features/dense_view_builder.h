/** Small images from full ones. */
#pragma once
#include <vector>

#include "rgbd_graphslam/features/dense_view.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"

namespace rgbd_graphslam {

/** Reduces images of one camera to the small views that dense alignment uses. */
class DenseViewBuilder {
  public:
    explicit DenseViewBuilder(const Camera& camera);

    /** Means over blocks of pixels. Thread-safe.
     *  \param image gray and depth of the camera's size */
    DenseView build(const RgbdImage& image) const;
    /** Of the views. */
    const Camera& camera() const { return small_; }

  private:
    int block_px_ = 1;
    Camera small_;
    std::vector<int> columns_, rows_;  // of each block's corner in the distorted image
};

}  // namespace rgbd_graphslam
