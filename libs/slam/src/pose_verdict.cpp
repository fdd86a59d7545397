#include "pose_verdict.h"

#include "pose_uncertainty.h"

namespace rgbd_graphslam {
namespace {

constexpr int few_inliers = 65;
/** Standard deviations of the weakest direction beyond which a pose is not built on. */
constexpr PoseSpread widest{0.025, 0.02};

}  // namespace

Verdict judge(const LocatedFrame& located, const SupposedMotion& measured,
              const SupposedMotion& inertial) {
    const auto fits = [](const SupposedMotion& motion, Agreement least) {
        const Agreement agreement = motion.prior.judge(motion.T_predicted_cam);
        if (agreement == Agreement::Contradicted) return false;
        return least == Agreement::Possible || agreement == Agreement::Confirmed ||
               !motion.prior.measured();
    };
    const bool few = located.inliers < few_inliers;
    if (few && !(fits(measured, Agreement::Confirmed) && fits(inertial, Agreement::Confirmed))) {
        return Verdict::Rejected;
    }
    if (!fits(inertial, Agreement::Possible)) return Verdict::Rejected;
    const PoseSpread spread = weakestDirection(covarianceAgainstMap(located));
    const bool open = spread.m > inertial.prior.scale() * widest.m || spread.rad > widest.rad;
    return open ? Verdict::Uncertain : Verdict::Believed;
}

}  // namespace rgbd_graphslam
