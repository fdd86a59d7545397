#include "keyframe_alignment.h"

#include <utility>
#include <vector>

#include "rgbd_graphslam/slam/keypoint_measurement.h"
#include "rgbd_graphslam/slam/matcher.h"
#include "rgbd_graphslam/slam/ransac_alignment.h"

namespace rgbd_graphslam {
namespace {

constexpr float match_ratio = 0.85f;
constexpr int fewest_aligned = 15;

/** Some of a frame's keypoints. */
struct Selection {
    std::vector<int> keypoints;
    std::vector<Descriptor> descriptors;
};

template <class Wanted>
Selection select(const Frame& frame, Wanted&& wanted) {
    Selection selection;
    for (std::size_t i = 0; i < frame.keypoints.size(); ++i) {
        if (!wanted(i)) continue;
        selection.keypoints.push_back(static_cast<int>(i));
        selection.descriptors.push_back(frame.descriptors[i]);
    }
    return selection;
}

/** Keypoints and the landmarks that look like them, pair by pair. */
struct Correspondences {
    std::vector<int> keypoints, landmarks;
    std::vector<PointMatch> matches;
    std::vector<Eigen::Vector3d> points_cam;
};

/** Only keypoints that can take part are compared: with depth on one side, with a landmark on the
 *  other. */
Correspondences correspond(const Frame& frame, const Keyframe& keyframe, const SlamMap& map,
                           const RigCameras& cameras, const SlamOptions& options) {
    const Selection seen =
        select(frame, [&](std::size_t i) { return frame.keypoints[i].depth_m > 0; });
    const Selection known =
        select(keyframe.frame, [&](std::size_t i) { return keyframe.landmarks[i] != no_landmark; });
    Correspondences found;
    for (const auto& [a, b] : matchMutually(seen.descriptors, known.descriptors,
                                            options.tracker.max_hamming, match_ratio)) {
        const int landmark = keyframe.landmarks[known.keypoints[b]];
        const Keypoint& k = frame.keypoints[seen.keypoints[a]];
        found.keypoints.push_back(seen.keypoints[a]);
        found.landmarks.push_back(landmark);
        found.matches.push_back({map.landmark(landmark).position,
                                 measurementOf(k, map.scaleOf(k.octave), options.sensor), 1,
                                 k.camera});
        found.points_cam.push_back(cameras.pointOf(k));
    }
    return found;
}

}  // namespace

std::optional<LocatedFrame> alignWithKeyframe(const Frame& frame, const Keyframe& keyframe,
                                              const SlamMap& map, const RigCameras& cameras,
                                              const SlamOptions& options) {
    const Correspondences found = correspond(frame, keyframe, map, cameras, options);
    if (static_cast<int>(found.matches.size()) < fewest_aligned) return std::nullopt;
    const auto aligned =
        alignRobustly(cameras, found.matches, found.points_cam, options.loops.ransac_iterations,
                      static_cast<std::uint64_t>(keyframe.id));
    if (!aligned || aligned->inliers < fewest_aligned) return std::nullopt;
    LocatedFrame located;
    located.T_cam_world =
        solvePose(cameras.mounted(), found.matches, aligned->T_cam_world).T_body_world;
    located.landmarks.assign(frame.keypoints.size(), no_landmark);
    for (std::size_t m = 0; m < found.matches.size(); ++m) {
        if (aligned->inlier[m]) located.landmarks[found.keypoints[m]] = found.landmarks[m];
    }
    located.inliers = aligned->inliers;
    return located;
}

}  // namespace rgbd_graphslam
