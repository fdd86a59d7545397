#include "keyframe_decision.h"

#include <algorithm>

#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr double default_depth_m = 2.0;
/** Below this share a keyframe is made however little the camera moved. */
constexpr double alarming_share = 0.5;

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
    const double translation = motion.t.norm() / median_depth_m_;
    const double rotation = motion.angle();
    const double share = static_cast<double>(located.inliers) / most_inliers_;
    const bool changed = translation > options_.min_translation_ratio ||
                         rotation > options_.min_rotation_rad || share < alarming_share;
    const bool due = translation > options_.max_translation_ratio ||
                     rotation > options_.max_rotation_rad || share < options_.min_tracked_share;
    return changed && due;
}

}  // namespace rgbd_graphslam
