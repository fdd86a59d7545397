#include "rgbd_graphslam/estimation/pose_graph.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <string>

#include "left_perturbation.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/estimation/lie_jacobians.h"

namespace rgbd_graphslam {
namespace {

constexpr int pose_size = blockSize(StateKind::Pose);
using PoseBlock = std::array<double, pose_size>;

Vector6d relativePoseResidual(const SE3& T_world_from, const SE3& T_world_to,
                              const SE3& measured_from_to, Matrix6d* jacobian_to) {
    const SE3 T_measured_world = (T_world_from * measured_from_to).inverse();
    const SE3 error = T_measured_world * T_world_to;
    Vector6d residual;
    residual << error.t, rotationLog(error.R);
    if (jacobian_to) {
        const Eigen::Matrix3d& R = T_measured_world.R;
        *jacobian_to << R, -R * skew(T_world_to.t), Eigen::Matrix3d::Zero(),
            inverseLeftJacobian(residual.tail<3>()) * R;
    }
    return residual;
}

class RelativePoseCost final : public ceres::SizedCostFunction<6, pose_size, pose_size> {
  public:
    /** \param whitening W with W^T W = information */
    RelativePoseCost(const SE3& measured, const Matrix6d& whitening)
        : measured_(measured), whitening_(whitening) {}

    bool Evaluate(double const* const* poses, double* residual, double** jacobians) const override {
        Matrix6d jacobian_to;
        const Vector6d error = relativePoseResidual(poseFrom(poses[0]), poseFrom(poses[1]),
                                                    measured_, jacobians ? &jacobian_to : nullptr);
        Eigen::Map<Vector6d>(residual).noalias() = whitening_ * error;
        if (!jacobians) return true;
        const Matrix6d whitened = whitening_ * jacobian_to;
        if (jacobians[0]) storeTangent(-whitened, jacobians[0]);
        if (jacobians[1]) storeTangent(whitened, jacobians[1]);
        return true;
    }

  private:
    static void storeTangent(const Matrix6d& jacobian, double* ambient) {
        Eigen::Map<Eigen::Matrix<double, 6, pose_size, Eigen::RowMajor>>(ambient) << jacobian,
            Matrix6d::Zero();
    }
    SE3 measured_;
    Matrix6d whitening_;
};

std::string nameOf(const PoseEdge& edge) {
    return "edge " + std::to_string(edge.from) + " - " + std::to_string(edge.to);
}

void checkEnds(const PoseEdge& edge, int nodes) {
    if (std::min(edge.from, edge.to) >= 0 && std::max(edge.from, edge.to) < nodes &&
        edge.from != edge.to) {
        return;
    }
    throw Error(nameOf(edge) + " of a pose graph of " + std::to_string(nodes) + " nodes",
                "give it two nodes of the graph");
}

void checkFixed(int fixed, int nodes) {
    if (fixed >= 0 && fixed < nodes) return;
    throw Error("node " + std::to_string(fixed) + " of a pose graph of " + std::to_string(nodes) +
                    " nodes cannot be held fixed",
                "name a node of the graph");
}

Matrix6d whiteningOf(const PoseEdge& edge) {
    const Eigen::LLT<Matrix6d> factor(edge.information);
    if (factor.info() != Eigen::Success || !edge.information.allFinite()) {
        throw Error(nameOf(edge) + ": the information matrix is not positive definite",
                    "give it the inverse of a covariance");
    }
    return factor.matrixU();
}

ceres::Solver::Options solverOptions(const PoseGraphOptions& options) {
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    solver.max_num_iterations = options.max_iterations;
    solver.function_tolerance = 1e-5;
    solver.num_threads = 1;
    solver.logging_type = ceres::SILENT;
    return solver;
}

ceres::Problem::Options withoutOwnership() {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
}

}  // namespace

void PoseGraphOptions::describe(OptionVisitor& v) {
    v.integer("max_iterations", max_iterations, 1, 1000, "",
              "Maximum Levenberg-Marquardt iterations");
    v.real("loop_kernel_sigmas", loop_kernel_sigmas, 0.1, 1000, "sigmas",
           "Residual at which a loop edge loses half its weight (Cauchy kernel)");
}

PoseGraphSummary optimizePoseGraph(PoseGraph& graph, const PoseGraphOptions& options, int fixed) {
    checkFixed(fixed, static_cast<int>(graph.nodes.size()));
    LeftPerturbation manifold;
    ceres::CauchyLoss loop_kernel(options.loop_kernel_sigmas);
    ceres::Problem problem(withoutOwnership());
    std::vector<PoseBlock> blocks(graph.nodes.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        store(graph.nodes[i], blocks[i].data());
        problem.AddParameterBlock(blocks[i].data(), pose_size, &manifold);
    }
    for (const PoseEdge& edge : graph.edges) {
        checkEnds(edge, static_cast<int>(blocks.size()));
        problem.AddResidualBlock(new RelativePoseCost(edge.T_from_to, whiteningOf(edge)),
                                 edge.kind == EdgeKind::Loop ? &loop_kernel : nullptr,
                                 blocks[edge.from].data(), blocks[edge.to].data());
    }
    problem.SetParameterBlockConstant(blocks[fixed].data());
    for (int node = 0; node < graph.fixed; ++node) {
        problem.SetParameterBlockConstant(blocks[node].data());
    }
    ceres::Solver::Summary summary;
    ceres::Solve(solverOptions(options), &problem, &summary);
    for (std::size_t i = 0; i < blocks.size(); ++i) graph.nodes[i] = poseFrom(blocks[i].data());
    return {summary.initial_cost, summary.final_cost,
            static_cast<int>(summary.iterations.size()) - 1,
            summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace rgbd_graphslam
