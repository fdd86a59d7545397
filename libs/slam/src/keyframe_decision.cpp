#include "keyframe_decision.h"

#include <algorithm>

#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr double default_depth_m = 2.0;
/** Below this share a keyframe is made however little the camera moved. */
constexpr double alarming_share = 0.5;
/** Share of the view that an older keyframe must know, and of what it knows that must be seen. */
constexpr double known_share = 0.5;
constexpr std::size_t keyframes_compared = 5;
constexpr std::size_t observers_that_establish = 3;

double medianDepth(const Frame& frame) {
    std::vector<float> depths;
    for (const Keypoint& k : frame.keypoints) {
        if (k.depth_m > 0) depths.push_back(k.depth_m);
    }
    if (depths.empty()) return default_depth_m;
    const auto middle = depths.begin() + depths.size() / 2;
    std::nth_element(depths.begin(), middle, depths.end());
    return *middle;
}

int establishedLandmarks(const Keyframe& keyframe, const SlamMap& map) {
    return static_cast<int>(
        std::count_if(keyframe.landmarks.begin(), keyframe.landmarks.end(), [&](int landmark) {
            return landmark != no_landmark &&
                   map.landmark(landmark).observations.size() >= observers_that_establish;
        }));
}

}  // namespace

int keypointsWithDepth(const Frame& frame) {
    return static_cast<int>(std::count_if(frame.keypoints.begin(), frame.keypoints.end(),
                                          [](const Keypoint& k) { return k.depth_m > 0; }));
}

void KeyframeDecision::reset(const Keyframe& keyframe) {
    keyframe_ = keyframe.id;
    median_depth_m_ = medianDepth(keyframe.frame);
    most_inliers_ = 0;
}

void KeyframeDecision::save(ByteWriter& out) const {
    out.putCount(keyframe_);
    out.put(median_depth_m_);
    out.put<std::int32_t>(most_inliers_);
}

void KeyframeDecision::load(ByteReader& in, std::size_t keyframes) {
    keyframe_ = getIndex(in, std::max<std::size_t>(1, keyframes), "keyframe");
    median_depth_m_ = getFinite(in);
    most_inliers_ = in.get<std::int32_t>();
}

bool KeyframeDecision::wants(const SlamMap& map, const LocatedFrame& located,
                             int frames_since_keyframe) {
    most_inliers_ = std::max(most_inliers_, located.inliers);
    if (frames_since_keyframe < options_.min_interval_frames) return false;
    const SE3 motion = located.T_cam_world * map.T_cam_world(keyframe_).inverse();
    const double share = static_cast<double>(located.inliers) / most_inliers_;
    const bool changed = motion.t.norm() > options_.min_translation_ratio * median_depth_m_ ||
                         motion.angle() > options_.min_rotation_rad || share < alarming_share;
    if (!changed) return false;
    if (share < options_.min_tracked_share) return true;
    return isFar(motion, median_depth_m_) && !turnsToKnown(map, located);
}

bool KeyframeDecision::isFar(const SE3& motion, double median_depth_m) const {
    return motion.t.norm() > options_.max_translation_ratio * median_depth_m ||
           motion.angle() > options_.max_rotation_rad;
}

/** Where the map has a keyframe of nearly this view, that one is compared with from now on: what
 *  is filmed again and again must not fill the map with keyframes that culling takes out again. */
bool KeyframeDecision::turnsToKnown(const SlamMap& map, const LocatedFrame& located) {
    auto known = map.observers(located.landmarks);
    if (known.size() > keyframes_compared) known.resize(keyframes_compared);
    for (const Covisibility& c : known) {
        const Keyframe& keyframe = map.keyframe(c.keyframe);
        const SE3 motion = located.T_cam_world * keyframe.T_cam_world.inverse();
        if (isFar(motion, medianDepth(keyframe.frame))) continue;
        if (c.shared < known_share * located.inliers) continue;
        if (located.inliers < known_share * establishedLandmarks(keyframe, map)) continue;
        reset(keyframe);
        most_inliers_ = located.inliers;
        return true;
    }
    return false;
}

}  // namespace rgbd_graphslam
