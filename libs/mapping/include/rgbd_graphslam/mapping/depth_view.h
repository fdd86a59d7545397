/** A depth image made ready for mapping. */
#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/depth_noise.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/mapping/depth_pyramid.h"
#include "rgbd_graphslam/mapping/map_options.h"

namespace rgbd_graphslam {

/** Where each pixel of a camera looks, free of lens distortion; computed once a camera. */
class RayTable {
  public:
    explicit RayTable(const Camera& camera);

    /** Direction of a pixel as (x / z, y / z) in the optical frame. */
    const Eigen::Vector2f* row(int v) const {
        return &directions_[static_cast<std::size_t>(v) * camera_.width];
    }

    /** The depth image as a camera without distortion would see it (nearest pixel, 0 = outside). */
    cv::Mat1f rectified(const cv::Mat1f& depth) const;

    const Camera& camera() const { return camera_; }
    /** The camera of rectified images. */
    const Camera& pinhole() const { return pinhole_; }

  private:
    Camera camera_, pinhole_;
    std::vector<Eigen::Vector2f> directions_;
    std::vector<int> rectified_from_;  // pixel index or -1; empty without distortion
};

/** Readings in meters along z, 0 where there is none or where it cannot be trusted: nearer than
 *  min_range_m, or "flying" between the two sides of a depth edge. Readings beyond max_range_m
 *  stay, for they tell that the space before them is free.
 *  \throws Error when the image is not 16 bit or of another size than the camera's */
cv::Mat1f cleanDepth(const RgbdImage& image, const Camera& camera, const MapOptions& options,
                     const DepthNoise& noise = {});

/** One keyframe's contribution to the maps. */
struct DepthView {
    DepthView(const RgbdImage& image, const RayTable& ray_table, const MapOptions& options);

    double stamp_s;  // of the image
    const RayTable& rays;
    cv::Mat1f depth;  // m, 0 = none
    cv::Mat3b color;  // BGR, of the depth's size; gray where the image has no color
    DepthPyramid sight;
    double max_range_m;
    DepthNoise noise;
};

}  // namespace rgbd_graphslam
