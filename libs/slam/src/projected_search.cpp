#include "projected_search.h"

#include <algorithm>

#include "rgbd_graphslam/estimation/reprojection.h"

namespace rgbd_graphslam {

ProjectedSearch::ProjectedSearch(const Frame& frame, const SE3& T_cam_world, const Camera& camera,
                                 const SlamMap& map)
    : T_cam_world_(T_cam_world),
      camera_(camera),
      map_(map),
      camera_position_(T_cam_world.inverse().t),
      table_(frame) {}

std::optional<ProjectedLandmark> ProjectedSearch::project(int landmark) const {
    const Eigen::Vector3d& position = map_.landmark(landmark).position;
    const Eigen::Vector3d p = T_cam_world_ * position;
    if (p.z() < nearest_depth_m) return std::nullopt;
    const Eigen::Vector2d pixel = camera_.project(p);
    if (!camera_.contains(pixel)) return std::nullopt;
    const Eigen::Vector3d to_camera = camera_position_ - position;
    return ProjectedLandmark{landmark, p.z(), pixel, to_camera, to_camera.norm()};
}

int ProjectedSearch::octave(const ProjectedLandmark& landmark) const {
    return map_.expectedOctave(map_.landmark(landmark.id), landmark.distance_m);
}

void ProjectedSearch::search(const ProjectedLandmark& landmark, int octave,
                             const SearchLimits& limits) {
    const double scale = map_.scaleOf(std::clamp(octave, 0, map_.levels() - 1));
    const auto radius = static_cast<float>(limits.window_px * scale + limits.uncertain_px);
    table_.search(landmark.id, map_.landmark(landmark.id).descriptor,
                  {static_cast<float>(landmark.pixel.x()), static_cast<float>(landmark.pixel.y()),
                   radius, octave - 1, octave + 1},
                  limits.max_hamming, limits.ratio);
}

}  // namespace rgbd_graphslam
