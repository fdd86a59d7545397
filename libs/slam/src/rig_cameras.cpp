#include "rgbd_graphslam/slam/rig_cameras.h"

#include <algorithm>
#include <stdexcept>

namespace rgbd_graphslam {

RigCameras::RigCameras(const Rig& rig) {
    if (rig.cameras.empty()) throw std::invalid_argument("a rig without cameras");
    const SE3 T_first_body = rig.cameras.front().T_body_cam.inverse();
    for (const RigCamera& camera : rig.cameras) {
        const bool is_first = rectified_.empty();
        const SE3 T_cam_first = is_first ? SE3() : (T_first_body * camera.T_body_cam).inverse();
        rectified_.emplace_back(camera.model.rectified(), T_cam_first);
        sensors_.push_back(camera.model);
        width_ = std::max(width_, camera.model.width);
        height_ = std::max(height_, camera.model.height);
    }
}

RigCameras::RigCameras(const CameraModel& camera) : RigCameras(rigOf(camera)) {}

KeypointGrid RigCameras::gridOf(const std::vector<Keypoint>& keypoints) const {
    return {keypoints, width_, height_, count()};
}

}  // namespace rgbd_graphslam
