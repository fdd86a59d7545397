/** Checks the derivatives of any factor. */
#pragma once
#include <gtest/gtest.h>

#include "rgbd_graphslam/estimation/factor_evaluation.h"

namespace rgbd_graphslam {

/** States with one of them perturbed along the i-th axis of its tangent space. */
inline States perturbed(States states, const StateKey& key, int axis, double step) {
    const auto index = static_cast<std::size_t>(key.index);
    if (key.kind == StateKind::Point) {
        states.points[index] += step * Eigen::Vector3d::Unit(axis);
        return states;
    }
    KeyframeState& keyframe = states.keyframes[index];
    const int first = key.kind == StateKind::Pose ? 0 : tangentSize(StateKind::Pose);
    keyframe = keyframe.retract(Vector15d(step * Vector15d::Unit(first + axis)));
    return states;
}

/** Expects each Jacobian of a factor to agree with central differences of its residual.
 *  \param tolerance of a column, relative to the Jacobian's norm */
inline void expectJacobiansMatch(const Factor& factor, const States& states,
                                 double tolerance = 1e-6, double step = 1e-6) {
    FactorEvaluation analytic(factor), ahead(factor), behind(factor);
    ASSERT_TRUE(analytic.evaluate(states, true));
    for (std::size_t i = 0; i < analytic.keys().size(); ++i) {
        const StateKey& key = analytic.keys()[i];
        const Eigen::MatrixXd jacobian = analytic.jacobian(static_cast<int>(i));
        for (int axis = 0; axis < tangentSize(key.kind); ++axis) {
            ASSERT_TRUE(ahead.evaluate(perturbed(states, key, axis, step), false));
            ASSERT_TRUE(behind.evaluate(perturbed(states, key, axis, -step), false));
            const Eigen::VectorXd numeric = (ahead.residual() - behind.residual()) / (2 * step);
            EXPECT_LT((jacobian.col(axis) - numeric).norm(), tolerance * jacobian.norm())
                << "state " << i << ", axis " << axis;
        }
    }
}

}  // namespace rgbd_graphslam
