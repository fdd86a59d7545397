#include "rgbd_graphslam/mapping/depth_timing.h"

#include <mrpt/obs/CObservationComment.h>

#include <cmath>

namespace rgbd_graphslam {

void noteDepthStamps(const mrpt::obs::CObservation& observation, DepthStamps& stamps) {
    const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&observation);
    if (comment) stamps.merge(depthStampsIn(comment->text));
}

double depthStamp(const DepthStamps& stamps, double color_stamp_s) {
    const auto found = stamps.find(std::llround(1e6 * color_stamp_s));
    return found == stamps.end() ? color_stamp_s : 1e-6 * static_cast<double>(found->second);
}

SE3 depthPose(const StampedPose& keyframe, double depth_stamp_s, const Trajectory& trajectory) {
    constexpr double longest_gap_s = 0.2;
    const auto T_color = poseAt(trajectory, keyframe.stamp_s, longest_gap_s),
               T_depth = poseAt(trajectory, depth_stamp_s, longest_gap_s);
    if (!T_color || !T_depth) return keyframe.T_world_cam;
    return keyframe.T_world_cam * (T_color->inverse() * *T_depth);
}

}  // namespace rgbd_graphslam
