#include "rgbd_graphslam/slam/global_adjustment.h"

#include <ceres/loss_function.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <cmath>
#include <memory>

#include "ceres_pose.h"

namespace rgbd_graphslam {
namespace {

class ReprojectionCost final : public ceres::SizedCostFunction<3, pose_size, 3> {
  public:
    ReprojectionCost(const Camera& camera, const Measurement& measurement)
        : camera_(camera), measurement_(measurement) {}

    bool Evaluate(double const* const* blocks, double* whitened,
                  double** jacobians) const override {
        const SE3 pose = poseOf(blocks[0]);
        const Eigen::Vector3d p = pose * Eigen::Map<const Eigen::Vector3d>(blocks[1]);
        if (p.z() < nearest_depth_m) return false;
        Eigen::Map<Eigen::Vector3d>{whitened} = residual(camera_, p, measurement_);
        if (!jacobians) return true;
        const Eigen::Matrix3d J = residualJacobian(camera_, p, measurement_);
        if (jacobians[0]) {
            Eigen::Map<RowMajor<3, pose_size>> by_pose(jacobians[0]);
            by_pose.setZero();
            by_pose.leftCols<3>() = J;
            by_pose.middleCols<3>(3) = -J * skew(p);
        }
        if (jacobians[1]) Eigen::Map<RowMajor<3, 3>>{jacobians[1]} = J * pose.R;
        return true;
    }

  private:
    const Camera& camera_;
    const Measurement measurement_;
};

BundleSummary minimize(BundleProblem& problem, int iterations) {
    std::vector<PoseBlock> poses(problem.T_cam_world.size());
    for (std::size_t c = 0; c < poses.size(); ++c) store(problem.T_cam_world[c], poses[c].data());
    LeftPerturbation manifold;
    ceres::Problem::Options ownership;
    ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem ceres_problem(ownership);
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (const BundleObservation& o : problem.observations) {
        // Ceres gives up on a problem that cannot be evaluated at its start.
        const double depth = (problem.T_cam_world[o.camera] * problem.points[o.point]).z();
        if (o.outlier || depth < nearest_depth_m) continue;
        double* const pose = poses[o.camera].data();
        double* const point = problem.points[o.point].data();
        ceres_problem.AddResidualBlock(new ReprojectionCost(problem.camera, o.measurement),
                                       new ceres::HuberLoss(std::sqrt(chi2Limit(o.measurement))),
                                       pose, point);
        ordering->AddElementToGroup(point, 0);
        ordering->AddElementToGroup(pose, 1);
    }
    for (std::size_t c = 0; c < poses.size(); ++c) {
        double* const pose = poses[c].data();
        if (!ceres_problem.HasParameterBlock(pose)) continue;
        ceres_problem.SetManifold(pose, &manifold);
        if (static_cast<int>(c) >= problem.free_cameras)
            ceres_problem.SetParameterBlockConstant(pose);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_SCHUR;
    options.linear_solver_ordering = ordering;
    options.max_num_iterations = iterations;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &ceres_problem, &summary);
    for (int c = 0; c < problem.free_cameras; ++c) problem.T_cam_world[c] = poseOf(poses[c].data());
    return {summary.initial_cost, summary.final_cost, static_cast<int>(summary.iterations.size())};
}

}  // namespace

BundleSummary adjustBundleSparse(BundleProblem& problem, int max_iterations, bool mark_outliers) {
    if (!mark_outliers) return minimize(problem, max_iterations);
    const BundleSummary first = minimize(problem, (max_iterations + 1) / 2);
    markBundleOutliers(problem);
    BundleSummary second = minimize(problem, (max_iterations + 1) / 2);
    second.initial_cost = first.initial_cost;
    second.iterations += first.iterations;
    return second;
}

}  // namespace rgbd_graphslam
