/** The cameras of a rig as tracking and mapping use them. */
#pragma once
#include <vector>

#include "rgbd_graphslam/estimation/reprojection.h"
#include "rgbd_graphslam/features/frame.h"
#include "rgbd_graphslam/geometry/rig.h"

namespace rgbd_graphslam {

/** Rectified, as keypoints are. The body is the first camera: poses named `cam` without a number
 *  are its. */
class RigCameras {
  public:
    /** \throws std::invalid_argument for a rig without cameras */
    explicit RigCameras(const Rig& rig);
    explicit RigCameras(const CameraModel& camera);

    const std::vector<MountedCamera>& mounted() const { return rectified_; }
    const MountedCamera& operator[](int camera) const { return rectified_[camera]; }
    int count() const { return static_cast<int>(rectified_.size()); }
    /** As its images are, lens included. */
    const CameraModel& sensor(int camera) const { return sensors_[camera]; }

    /** What a keypoint with depth shows, in the body's coordinates. */
    Eigen::Vector3d pointOf(const Keypoint& k) const {
        const MountedCamera& camera = rectified_[k.camera];
        return camera.toBody(camera.camera().unproject(k.u, k.v, k.depth_m));
    }
    KeypointGrid gridOf(const std::vector<Keypoint>& keypoints) const;

    /** Calls visit(camera, pixel, depth_m) for the cameras that have the point in their image until
     *  one returns true. \param p_body in the body's coordinates
     *  \return whether one did */
    template <class Visit>
    bool visitViews(const Eigen::Vector3d& p_body, Visit&& visit) const {
        for (int i = 0; i < count(); ++i) {
            const CameraModel& camera = rectified_[i].camera();
            const Eigen::Vector3d p = rectified_[i].fromBody(p_body);
            if (p.z() < nearest_depth_m) continue;
            const Eigen::Vector2d pixel = camera.project(p);
            if (camera.contains(pixel) && visit(i, pixel, p.z())) return true;
        }
        return false;
    }

  private:
    std::vector<MountedCamera> rectified_;
    std::vector<CameraModel> sensors_;
    int width_ = 0, height_ = 0;  // of the largest image
};

}  // namespace rgbd_graphslam
