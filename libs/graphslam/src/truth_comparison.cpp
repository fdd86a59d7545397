#include "truth_comparison.h"

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

std::optional<TruthComparison> compareWithTruth(const Trajectory& estimate,
                                                const Trajectory& truth) {
    if (truth.empty()) return std::nullopt;
    try {
        TruthComparison comparison{evaluateAte(estimate, truth), {}};
        const SE3 T_estimate_truth = comparison.ate.alignment.motion.inverse();
        for (const StampedPose& pose : estimate) {
            constexpr double longest_gap_s = 0.1;
            const auto T_truth_cam = poseAt(truth, pose.stamp_s, longest_gap_s);
            if (!T_truth_cam) continue;
            comparison.truth.push_back({pose.stamp_s, T_estimate_truth * *T_truth_cam});
        }
        return comparison;
    } catch (const Error& e) {
        sayWarning(std::string("no ATE: ") + e.what());
        return std::nullopt;
    }
}

}  // namespace rgbd_graphslam
