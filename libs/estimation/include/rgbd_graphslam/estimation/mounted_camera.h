/** A camera and its place on the body. */
#pragma once
#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A camera with its place on the body; most often the camera is the body. */
class MountedCamera {
  public:
    explicit MountedCamera(const Camera& camera = {}, const SE3& T_cam_body = {})
        : camera_(camera),
          T_cam_body_(T_cam_body),
          T_body_cam_(T_cam_body.inverse()),
          is_body_(T_cam_body.R.isIdentity(0) && T_cam_body.t.isZero(0)) {}

    const Camera& camera() const { return camera_; }
    const SE3& T_cam_body() const { return T_cam_body_; }

    /** From the body's coordinates to the camera's. */
    Eigen::Vector3d fromBody(const Eigen::Vector3d& p_body) const {
        Eigen::Vector3d p = p_body;
        if (!is_body_) p = T_cam_body_ * p_body;
        return p;
    }
    /** The camera's pose, from the body's. */
    SE3 fromBody(const SE3& T_body_world) const {
        return is_body_ ? T_body_world : T_cam_body_ * T_body_world;
    }
    /** From the camera's coordinates to the body's. */
    Eigen::Vector3d toBody(const Eigen::Vector3d& p_cam) const {
        return is_body_ ? p_cam : T_body_cam_ * p_cam;
    }
    /** Turns derivatives by a point in the camera's coordinates into those by the point in the
     * body's, in place. */
    void changeToBody(Eigen::Matrix3d& by_point) const {
        if (!is_body_) by_point *= T_cam_body_.R;
    }

  private:
    Camera camera_;
    SE3 T_cam_body_, T_body_cam_;
    /** Most often there is one camera, which defines the body: nothing to multiply. */
    bool is_body_;
};

}  // namespace rgbd_graphslam
