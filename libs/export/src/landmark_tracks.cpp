#include "landmark_tracks.h"

#include <filesystem>

#include "rgbd_graphslam/job/sparse_map_file.h"

namespace rgbd_graphslam {
namespace {

LandmarkTrack trackOf(const Landmark& landmark, const SparseMap& map) {
    const MapSnapshot& snapshot = map.snapshot;
    const CameraModel camera = snapshot.rig.cameras.front().model.rectified();
    LandmarkTrack track;
    track.position = map.T_up_world * landmark.position;
    for (const Observation& observation : landmark.observations) {
        const Keypoint& keypoint =
            snapshot.keyframes[observation.keyframe].frame.keypoints[observation.keypoint];
        if (keypoint.camera != 0) continue;  // images are the first camera's
        track.seen.push_back(
            {observation.keyframe, camera.unproject(keypoint.u, keypoint.v, 1).head<2>()});
    }
    return track;
}

}  // namespace

std::optional<std::vector<LandmarkTrack>> readLandmarkTracks(const std::string& run_folder) {
    const auto path = std::filesystem::path(run_folder) / sparse_map_name;
    if (!std::filesystem::exists(path)) return std::nullopt;
    const SparseMap map = readSparseMap(path.string());
    std::vector<LandmarkTrack> tracks;
    for (const Landmark& landmark : map.snapshot.landmarks)
        tracks.push_back(trackOf(landmark, map));
    return tracks;
}

}  // namespace rgbd_graphslam
