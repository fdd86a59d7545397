/** Cameras on one rigid body. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/camera_model.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** One camera of a rig. */
struct RigCamera {
    std::string label;  // of the sensor, as observations have it
    CameraModel model;
    SE3 T_body_cam;  // camera: optical frame
    /** Focal length times baseline of a rectified stereo camera, whose depth errors follow from
     *  those of its disparities; 0 = a depth camera. */
    double disparity_m_px = 0;
};

/** Numbered from 0 in the order given; see Keypoint::camera. */
struct Rig {
    std::vector<RigCamera> cameras;

    /** The camera of a sensor. */
    std::optional<int> find(const std::string& label) const;
    /** Labels of two cameras in the same place that look the same way: a mistake in extrinsics. */
    std::optional<std::pair<std::string, std::string>> coincident() const;
};

/** Of one camera, which is the body. */
Rig rigOf(const CameraModel& camera);

}  // namespace rgbd_graphslam
