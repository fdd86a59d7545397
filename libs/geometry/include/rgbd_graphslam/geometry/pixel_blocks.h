/** Small depth images from full ones. */
#pragma once
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"

namespace rgbd_graphslam {

/** Square blocks of pixels, some 80 to a row. A small image has one pixel per block and no lens
 *  distortion; each block lies where the lens shows its pixel. */
class PixelBlocks {
  public:
    explicit PixelBlocks(const Camera& camera);

    /** Of the small image. */
    const Camera& camera() const { return small_; }
    int size() const { return block_px_; }
    std::size_t count() const { return columns_.size(); }
    /** Top left pixel of block i, counted row by row. */
    int column(std::size_t i) const { return columns_[i]; }
    int row(std::size_t i) const { return rows_[i]; }

    /** Depth in m of each block, row by row: the mean of its nearest surface; 0 where less than
     *  half of the block has readings. \param image depth of the camera's size */
    std::vector<float> depthOf(const RgbdImage& image) const;

    /** The block that an undistorted pixel of the full image falls into; -1 outside. */
    int blockAt(double u, double v) const;

  private:
    int block_px_ = 1;
    Camera small_;
    std::vector<int> columns_, rows_;
};

}  // namespace rgbd_graphslam
