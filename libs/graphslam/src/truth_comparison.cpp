#include "truth_comparison.h"

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/associate.h"

namespace rgbd_graphslam {
namespace {

std::vector<double> stampsOf(const Trajectory& poses) {
    std::vector<double> stamps_s;
    for (const StampedPose& pose : poses) stamps_s.push_back(pose.stamp_s);
    return stamps_s;
}

}  // namespace

std::optional<TruthComparison> compareWithTruth(const Trajectory& estimate,
                                                const Trajectory& truth) {
    if (truth.empty()) return std::nullopt;
    try {
        TruthComparison comparison{evaluateAte(estimate, truth), {}};
        const SE3 T_estimate_truth = comparison.ate.alignment.motion.inverse();
        for (const auto& pair :
             associate(stampsOf(truth), stampsOf(estimate), AteOptions().max_difference_s)) {
            const StampedPose& pose = truth[pair.first];
            comparison.truth.push_back({pose.stamp_s, T_estimate_truth * pose.T_world_cam});
        }
        return comparison;
    } catch (const Error& e) {
        sayWarning(std::string("no ATE: ") + e.what());
        return std::nullopt;
    }
}

}  // namespace rgbd_graphslam
