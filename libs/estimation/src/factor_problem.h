/** States and factors as a problem of Ceres. */
#pragma once
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>

#include <array>
#include <memory>
#include <vector>

#include "left_perturbation.h"
#include "rgbd_graphslam/estimation/factor.h"

namespace rgbd_graphslam {

/** A kernel as Ceres' loss; null for none. */
std::unique_ptr<ceres::LossFunction> lossOf(const RobustKernel& kernel);

/** Copies the states into blocks, which Ceres changes. */
class FactorProblem {
  public:
    explicit FactorProblem(const States& states);
    FactorProblem(const FactorProblem&) = delete;
    FactorProblem& operator=(const FactorProblem&) = delete;

    /** \param factor must outlive the problem */
    void add(const Factor& factor);

    /** Keeps a keyframe as it is. */
    void hold(int keyframe);

    ceres::Problem& problem() { return problem_; }

    /** Order of elimination for what was added: points, then keyframes. */
    std::shared_ptr<ceres::ParameterBlockOrdering> pointsFirst();

    KeyframeState keyframe(int keyframe) const;
    const std::vector<Eigen::Vector3d>& points() const { return points_; }

  private:
    /** Pose, then motion, so that blocks lie in the order of keyframes: Ceres orders by address. */
    static constexpr int motion_offset = blockSize(StateKind::Pose);
    using KeyframeBlock = std::array<double, motion_offset + blockSize(StateKind::Motion)>;

    double* block(const StateKey& key);

    std::vector<KeyframeBlock> keyframes_;
    std::vector<bool> has_pose_;
    std::vector<Eigen::Vector3d> points_;
    LeftPerturbation manifold_;
    ceres::Problem problem_;
};

}  // namespace rgbd_graphslam
