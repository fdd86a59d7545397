#include "factor_problem.h"

#include <ceres/cost_function.h>
#include <ceres/loss_function.h>

#include <cmath>

namespace rgbd_graphslam {
namespace {

/** Any factor as a cost of Ceres. */
class FactorCost final : public ceres::CostFunction {
  public:
    FactorCost(const Factor& factor, const std::vector<StateKey>& keys) : factor_(factor) {
        for (const StateKey& key : keys) {
            mutable_parameter_block_sizes()->push_back(blockSize(key.kind));
        }
        set_num_residuals(factor.residualSize());
    }
    bool Evaluate(double const* const* blocks, double* residual,
                  double** jacobians) const override {
        Linearization out(residual, jacobians);
        return factor_.linearize(StateBlocks(blocks), out);
    }

  private:
    const Factor& factor_;
};

class GemanMcClureLoss final : public ceres::LossFunction {
  public:
    explicit GemanMcClureLoss(double limit) : limit_(limit) {}
    void Evaluate(double chi2, double rho[3]) const override {
        const RobustCost robust = gemanMcClure(chi2, limit_);
        rho[0] = robust.cost;
        rho[1] = robust.weight;
        rho[2] = -2 * robust.weight / (limit_ + chi2);
    }

  private:
    double limit_;
};

}  // namespace

std::unique_ptr<ceres::LossFunction> lossOf(const RobustKernel& kernel) {
    switch (kernel.shape) {
        case KernelShape::Huber:
            return std::make_unique<ceres::HuberLoss>(std::sqrt(kernel.limit));
        case KernelShape::Cauchy:
            return std::make_unique<ceres::CauchyLoss>(std::sqrt(kernel.limit));
        case KernelShape::GemanMcClure:
            return std::make_unique<GemanMcClureLoss>(kernel.limit);
        case KernelShape::None:
            break;
    }
    return nullptr;
}

FactorProblem::FactorProblem(const States& states)
    : keyframes_(states.keyframes.size()),
      has_pose_(states.keyframes.size()),
      points_(states.points),
      problem_([] {
          ceres::Problem::Options options;
          options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
          return options;
      }()) {
    for (std::size_t k = 0; k < keyframes_.size(); ++k) {
        const KeyframeState& state = states.keyframes[k];
        store(state.T_body_world, keyframes_[k].data());
        store(state.motion, keyframes_[k].data() + motion_offset);
    }
}

double* FactorProblem::block(const StateKey& key) {
    const auto index = static_cast<std::size_t>(key.index);
    if (key.kind == StateKind::Point) return points_[index].data();
    double* const keyframe = keyframes_[index].data();
    return key.kind == StateKind::Pose ? keyframe : keyframe + motion_offset;
}

void FactorProblem::add(const Factor& factor) {
    const std::vector<StateKey> keys = factor.states();
    std::vector<double*> blocks;
    for (const StateKey& key : keys) {
        blocks.push_back(block(key));
        if (key.kind != StateKind::Pose || has_pose_[key.index]) continue;
        problem_.AddParameterBlock(blocks.back(), blockSize(key.kind), &manifold_);
        has_pose_[key.index] = true;
    }
    problem_.AddResidualBlock(new FactorCost(factor, keys), lossOf(factor.kernel()).release(),
                              blocks);
}

std::shared_ptr<ceres::ParameterBlockOrdering> FactorProblem::pointsFirst() {
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    const auto put = [&](double* block, int group) {
        if (problem_.HasParameterBlock(block)) ordering->AddElementToGroup(block, group);
    };
    for (Eigen::Vector3d& point : points_) put(point.data(), 0);
    for (KeyframeBlock& keyframe : keyframes_) {
        put(keyframe.data(), 1);
        put(keyframe.data() + motion_offset, 1);
    }
    return ordering;
}

void FactorProblem::hold(int keyframe) {
    for (const StateKey& key : {poseKey(keyframe), motionKey(keyframe)}) {
        if (!problem_.HasParameterBlock(block(key))) continue;
        problem_.SetParameterBlockConstant(block(key));
    }
}

KeyframeState FactorProblem::keyframe(int keyframe) const {
    const double* const block = keyframes_[static_cast<std::size_t>(keyframe)].data();
    return {poseFrom(block), motionFrom(block + motion_offset)};
}

}  // namespace rgbd_graphslam
