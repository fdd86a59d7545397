#include "pose_verdict.h"

#include "pose_uncertainty.h"

namespace rgbd_graphslam {
namespace {

constexpr int few_inliers = 65;
/** Standard deviations of the weakest direction beyond which a pose is not built on. */
constexpr PoseSpread widest{0.05, 0.04};

}  // namespace

Verdict judge(const LocatedFrame& located, const SE3& T_predicted_cam, const MotionPrior& prior) {
    const Agreement agreement = prior.judge(T_predicted_cam);
    if (agreement == Agreement::Contradicted) return Verdict::Rejected;
    const bool few = located.inliers < few_inliers;
    if (few && prior.measured() && agreement != Agreement::Confirmed) return Verdict::Rejected;
    const PoseSpread spread = weakestDirection(covarianceAgainstMap(located));
    const bool open = spread.m > widest.m || spread.rad > widest.rad;
    return open ? Verdict::Uncertain : Verdict::Believed;
}

}  // namespace rgbd_graphslam
