/** Evaluates a factor at the states of a problem. */
#pragma once
#include <array>
#include <vector>

#include "rgbd_graphslam/estimation/factor.h"

namespace rgbd_graphslam {

/** Values of a factor's residual and Jacobians, with the memory that they are written to. */
class FactorEvaluation {
  public:
    /** \param factor must outlive the evaluation */
    explicit FactorEvaluation(const Factor& factor);

    const std::vector<StateKey>& keys() const { return keys_; }

    /** \return false where the factor is not defined */
    bool evaluate(const States& states, bool with_jacobians);

    /** Of the last evaluation. */
    const Eigen::VectorXd& residual() const { return residual_; }
    /** Derivative by the tangent vector of the i-th state, if the last evaluation was with
     *  Jacobians. */
    Eigen::MatrixXd jacobian(int i) const;

  private:
    using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Factor& factor_;
    std::vector<StateKey> keys_;
    std::vector<std::array<double, blockSize(StateKind::Pose)>> blocks_;
    Eigen::VectorXd residual_;
    std::vector<RowMajorMatrix> jacobians_;
};

}  // namespace rgbd_graphslam
