#include "rgbd_graphslam/dataset/tracked_motion.h"

namespace rgbd_graphslam {

TrackedStretches stretchesOf(const Trajectory& trajectory, double longest_gap_s) {
    TrackedStretches stretches;
    double last_s = 0;
    for (const StampedPose& pose : trajectory) {
        if (stretches.empty() || !(pose.stamp_s - last_s <= longest_gap_s)) stretches.push_back({});
        stretches.back().push_back(pose);
        last_s = pose.stamp_s;
    }
    return stretches;
}

TrackedStretches movedAlong(const TrackedStretches& camera, const SE3& T_cam_other) {
    TrackedStretches others = camera;
    for (Trajectory& stretch : others) {
        for (StampedPose& pose : stretch) pose.T_world_cam = pose.T_world_cam * T_cam_other;
    }
    return others;
}

}  // namespace rgbd_graphslam
