#include "rgbd_graphslam/viewer/true_errors.h"

#include <cmath>

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

int visibleScale(const std::vector<TrueError>& errors, double scene_m) {
    constexpr double visible_share = 0.01;
    if (errors.empty()) return 1;
    double squares_m2 = 0;
    for (const TrueError& error : errors) squares_m2 += error.m() * error.m();
    const double rms_m = std::sqrt(squares_m2 / static_cast<double>(errors.size()));
    int scale = 1;
    for (const int larger : {2, 5, 10, 20, 50, 100}) {
        if (larger * rms_m <= visible_share * scene_m) scale = larger;
    }
    return scale;
}

}  // namespace rgbd_graphslam
