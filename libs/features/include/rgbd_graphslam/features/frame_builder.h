/** From image to frame. */
#pragma once
#include <memory>

#include "rgbd_graphslam/features/dense_view_builder.h"
#include "rgbd_graphslam/features/frame.h"
#include "rgbd_graphslam/features/orb_extractor.h"
#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"

namespace rgbd_graphslam {

/** Makes frames of the images of one camera. */
class FrameBuilder {
  public:
    FrameBuilder(const FeatureOptions& options, const Camera& camera);

    /** Extracts corners, rectifies their positions and reads their depth, or matches it where the
     *  image has a right one (see StereoMatcher). Thread-safe. The frame shares the pixels until
     * its view is dropped. \throws Error when the images are not of the camera's size or of the
     * wrong type */
    Frame build(const RgbdImage& image) const;
    /** Of the frames' small images. */
    const Camera& viewCamera() const { return dense_->camera(); }

  private:
    FeatureOptions options_;
    Camera camera_;
    OrbExtractor extractor_;
    std::shared_ptr<const DenseViewBuilder> dense_;
};

/** Depth at a pixel from its 3x3 neighborhood: the mean of the readings that belong to the nearest
 *  surface there, so that a keypoint on a depth edge takes the foreground.
 *  \param depth CV_16UC1; \param depth_unit_m meters a unit
 *  \return m; 0 when there are too few readings or they lie outside the believed range */
float foregroundDepth(const cv::Mat& depth, double depth_unit_m, float u, float v,
                      const FeatureOptions& options);

}  // namespace rgbd_graphslam
