/** Where one camera may see what another saw. */
#pragma once
#include "rgbd_graphslam/features/frame.h"
#include "rgbd_graphslam/geometry/camera_model.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** Hartley and Zisserman, "Multiple view geometry in computer vision", chapter 9. A keypoint of
 *  camera a spans a plane with the two centers: a line in the image of a pinhole camera b, any
 * curve in that of a fisheye. */
class EpipolarGeometry {
  public:
    /** \param a, b rectified */
    EpipolarGeometry(const CameraModel& a, const CameraModel& b, const SE3& T_b_a);

    /** Line in camera b, homogeneous; for a fisheye the normal of the plane. */
    Eigen::Vector3d lineOf(const Keypoint& a) const;
    /** Squared distance of keypoint b from a line, in units of its variance. */
    double chi2(const Eigen::Vector3d& line, const Keypoint& b, double sigma_px) const;

  private:
    const CameraModel& a_;
    const CameraModel& b_;
    Eigen::Matrix3d line_from_ray_;  // ray: homogeneous pixel, or bearing of a fisheye
};

}  // namespace rgbd_graphslam
