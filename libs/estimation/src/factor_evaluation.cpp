#include "rgbd_graphslam/estimation/factor_evaluation.h"

namespace rgbd_graphslam {
namespace {

void gather(const StateKey& key, const States& states, double* block) {
    const auto index = static_cast<std::size_t>(key.index);
    switch (key.kind) {
        case StateKind::Pose:
            store(states.keyframes[index].T_body_world, block);
            break;
        case StateKind::Motion:
            store(states.keyframes[index].motion, block);
            break;
        case StateKind::Point:
            Eigen::Map<Eigen::Vector3d>{block} = states.points[index];
            break;
    }
}

}  // namespace

FactorEvaluation::FactorEvaluation(const Factor& factor)
    : factor_(factor),
      keys_(factor.states()),
      blocks_(keys_.size()),
      residual_(factor.residualSize()) {
    for (const StateKey& key : keys_) {
        jacobians_.emplace_back(factor.residualSize(), blockSize(key.kind));
    }
}

bool FactorEvaluation::evaluate(const States& states, bool with_jacobians) {
    std::vector<const double*> blocks;
    std::vector<double*> jacobians;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        gather(keys_[i], states, blocks_[i].data());
        blocks.push_back(blocks_[i].data());
        jacobians.push_back(jacobians_[i].data());
    }
    Linearization out(residual_.data(), with_jacobians ? jacobians.data() : nullptr);
    return factor_.linearize(StateBlocks(blocks.data()), out);
}

Eigen::MatrixXd FactorEvaluation::jacobian(int i) const {
    const auto index = static_cast<std::size_t>(i);
    return jacobians_[index].leftCols(tangentSize(keys_[index].kind));
}

}  // namespace rgbd_graphslam
