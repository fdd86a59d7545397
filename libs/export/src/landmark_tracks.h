/** Landmarks of a run and where its keyframes see them. */
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"

namespace rgbd_graphslam {

struct TrackElement {
    int keyframe = 0;                                     // line of keyframes.txt, from 0
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();  // (x / z, y / z) in the optical frame
};

struct LandmarkTrack {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, in the run's world
    std::vector<TrackElement> seen;                      // by rising keyframe
};

/** \return nothing when the run has no map.sparse
 *  \throws Error when it is damaged */
std::optional<std::vector<LandmarkTrack>> readLandmarkTracks(const std::string& run_folder);

}  // namespace rgbd_graphslam
