/** A sensor that the library does not know: all that it takes is in this file. */
#include <gtest/gtest.h>

#include <algorithm>

#include "../../support/factor_jacobians.h"
#include "bundle.h"
#include "rgbd_graphslam/estimation/global_adjustment.h"

namespace rgbd_graphslam {
namespace {

/** Height of a keyframe's body, the z coordinate of its place in the world. */
class Barometer final : public Factor {
  public:
    Barometer(int keyframe, double height_m, double sigma_m)
        : keyframe_(keyframe), height_m_(height_m), sigma_m_(sigma_m) {}

    std::vector<StateKey> states() const override { return {poseKey(keyframe_)}; }
    int residualSize() const override { return 1; }
    RobustKernel kernel() const override { return {KernelShape::Huber, 9}; }

    bool linearize(const StateBlocks& states, Linearization& out) const override {
        const SE3 T_world_body = states.pose(0).inverse();
        using Residual = Eigen::Matrix<double, 1, 1>;
        out.setResidual(Residual((T_world_body.t.z() - height_m_) / sigma_m_));
        if (!out.wantsJacobians()) return true;
        Eigen::Matrix<double, 1, 6> J;
        J << -T_world_body.R.row(2) / sigma_m_, 0, 0, 0;
        out.setJacobian(0, J);
        return true;
    }

  private:
    int keyframe_;
    double height_m_, sigma_m_;
};

TEST(Barometer, jacobianMatches) {
    RandomInputs random(1);
    for (int i = 0; i < 100; ++i) {
        const States states{{{random.pose(), {}}}, {}};
        expectJacobiansMatch(Barometer(0, random.uniform(-1, 1), 0.1), states);
    }
}

/** Points seen without depth from keyframes of which only the first is held: scale is unknown until
 *  another keyframe's height is measured. */
Bundle scaleless() {
    Bundle bundle = someBundle(2, 0, 0);
    for (BundleObservation& o : bundle.problem.observations) o.measurement.weight_depth = 0;
    std::reverse(bundle.truth.begin(), bundle.truth.end());
    std::reverse(bundle.problem.states.keyframes.begin(), bundle.problem.states.keyframes.end());
    for (BundleObservation& o : bundle.problem.observations) o.keyframe = 7 - o.keyframe;
    bundle.problem.free_keyframes = 7;
    bundle.problem.states.keyframes[7].T_body_world = bundle.truth[7];
    const SE3 T_held_world = bundle.truth[7];
    const auto scaled = [&](const Eigen::Vector3d& p) {
        return T_held_world.inverse() * (1.2 * (T_held_world * p));
    };
    for (auto& k : bundle.problem.states.keyframes) {
        const Eigen::Vector3d place = scaled(k.T_body_world.inverse().t);
        k.T_body_world.t = -(k.T_body_world.R * place);
    }
    for (Eigen::Vector3d& p : bundle.problem.states.points) p = scaled(p);
    return bundle;
}

TEST(Barometer, bothSolversTakeItAsItIs) {
    for (const auto& adjust : {adjustBundle, adjustBundleSparse}) {
        Bundle without = scaleless(), with = without;
        adjust(without.problem, 100, false);
        EXPECT_GT(largestError(without), 0.05);
        const double height_m = with.truth[0].inverse().t.z();
        with.problem.factors.push_back(std::make_shared<Barometer>(0, height_m, 0.001));
        adjust(with.problem, 100, false);
        EXPECT_LT(largestError(with), 1e-3);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
