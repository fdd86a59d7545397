/** Small images from full ones. */
#pragma once
#include "rgbd_graphslam/features/dense_view.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"

namespace rgbd_graphslam {

/** Reduces images of one camera to the small views that dense alignment uses. */
class DenseViewBuilder {
  public:
    explicit DenseViewBuilder(const Camera& camera) : blocks_(camera) {}

    /** Means over blocks of pixels. Thread-safe.
     *  \param image gray and depth of the camera's size */
    DenseView build(const RgbdImage& image) const;
    /** Of the views. */
    const Camera& camera() const { return blocks_.camera(); }

  private:
    PixelBlocks blocks_;
};

}  // namespace rgbd_graphslam
