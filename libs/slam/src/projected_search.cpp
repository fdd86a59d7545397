#include "projected_search.h"

#include <algorithm>

namespace rgbd_graphslam {

ProjectedSearch::ProjectedSearch(const Frame& frame, const SE3& T_cam_world,
                                 const RigCameras& cameras, const SlamMap& map)
    : T_cam_world_(T_cam_world),
      cameras_(cameras),
      map_(map),
      camera_position_(T_cam_world.inverse().t),
      table_(frame) {}

int ProjectedSearch::octave(const ProjectedLandmark& landmark) const {
    return map_.expectedOctave(map_.landmark(landmark.id), landmark.distance_m);
}

bool ProjectedSearch::search(const ProjectedLandmark& landmark, int octave,
                             const SearchLimits& limits) {
    const double scale = map_.scaleOf(std::clamp(octave, 0, map_.levels() - 1));
    const auto radius = static_cast<float>(limits.window_px * scale + limits.uncertain_px);
    return table_.search(landmark.id, map_.landmark(landmark.id).descriptor,
                         windowAt(landmark.camera, landmark.pixel, radius, octave),
                         limits.max_hamming, limits.ratio);
}

}  // namespace rgbd_graphslam
