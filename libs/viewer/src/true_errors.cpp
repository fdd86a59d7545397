#include "rgbd_graphslam/viewer/true_errors.h"

namespace rgbd_graphslam {

std::vector<TrueError> trueErrors(const Trajectory& estimate, const Trajectory& truth) {
    constexpr double same_s = 1e-6;  // files round to it
    std::vector<TrueError> errors;
    auto pose = estimate.begin();
    for (const StampedPose& true_pose : truth) {
        while (pose != estimate.end() && pose->stamp_s < true_pose.stamp_s - same_s) ++pose;
        if (pose == estimate.end() || pose->stamp_s > true_pose.stamp_s + same_s) continue;
        errors.push_back({pose->stamp_s, pose->T_world_cam.t, true_pose.T_world_cam.t});
    }
    return errors;
}

}  // namespace rgbd_graphslam
