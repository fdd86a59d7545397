#include "truth_comparison.h"

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr double longest_gap_s = 0.1;

}  // namespace

std::optional<TruthComparison> compareWithTruth(const Trajectory& estimate,
                                                const Trajectory& truth) {
    if (truth.empty() || estimate.empty()) return std::nullopt;
    try {
        TruthComparison comparison{evaluateAte(estimate, truth), {}};
        const SE3 T_estimate_truth = comparison.ate.alignment.motion.inverse();
        for (const StampedPose& pose : estimate) {
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

std::optional<double> edgeErrorM(const PoseEdge& edge, double from_s, double to_s,
                                 const Trajectory& truth) {
    const auto T_truth_from = poseAt(truth, from_s, longest_gap_s);
    const auto T_truth_to = poseAt(truth, to_s, longest_gap_s);
    if (!T_truth_from || !T_truth_to) return std::nullopt;
    const SE3 T_from_to = T_truth_from->inverse() * *T_truth_to;
    return (T_from_to.inverse() * edge.T_from_to).t.norm();
}

}  // namespace rgbd_graphslam
