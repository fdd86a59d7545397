/** Depth as another camera would see it. */
#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** Warps images of a depth camera to a color camera beside it. */
class DepthRegistration {
  public:
    /** \param T_color_depth from the depth camera's optical frame to the color camera's
     *  \param unit_m meters a unit of depth */
    DepthRegistration(const Camera& depth, const Camera& color, const SE3& T_color_depth,
                      double unit_m);

    /** Each reading goes where color sees it, as large as color sees its pixel; of several at one
     *  place the nearest stays. What depth could not see behind things has no reading.
     *  \param depth CV_16UC1 of the depth camera's size
     *  \return CV_16UC1 of the color camera's size, in the same unit */
    cv::Mat operator()(const cv::Mat& depth) const;

  private:
    void place(const Eigen::Vector3d& point_m, const Eigen::Vector2d& reach_px,
               cv::Mat1w& to) const;

    Camera depth_, color_;
    SE3 T_color_depth_;
    double unit_m_;
    std::vector<Eigen::Vector3d> rays_;  // of the depth camera, z = 1, row by row
};

}  // namespace rgbd_graphslam
