#include "rgbd_graphslam/slam/pose_solver.h"

#include <Eigen/Cholesky>

#include "rgbd_graphslam/slam/robust_kernel.h"

namespace rgbd_graphslam {
namespace {

constexpr int rounds = 3;
constexpr int steps_a_round = 5;
constexpr double converged_step = 1e-5;  // m and rad

struct NormalEquations {
    Matrix6d H = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();
    double cost = 0;
};

class Solver {
  public:
    Solver(const Camera& camera, const std::vector<PointMatch>& matches, const SE3& initial,
           PoseKernel kernel)
        : camera_(camera),
          matches_(matches),
          pose_(initial),
          used_(matches.size(), true),
          kernel_(kernel) {}

    PoseSolution solve() {
        for (int round = 0; round < rounds; ++round) {
            minimize();
            kernel_ = PoseKernel::Huber;
            if (!reclassify() && round > 0) break;
        }
        PoseSolution solution;
        solution.T_cam_world = pose_;
        solution.inlier.assign(used_.begin(), used_.end());
        for (const bool inlier : used_) solution.inliers += inlier;
        solution.information = build(pose_).H;
        return solution;
    }

  private:
    RobustCost robust(const PointMatch& match, double chi2) const {
        const double limit = chi2Limit(match.measurement);
        RobustCost robust =
            kernel_ == PoseKernel::Huber ? huber(chi2, limit) : gemanMcClure(chi2, limit);
        robust.cost *= match.trust;
        robust.weight *= match.trust;
        return robust;
    }

    NormalEquations build(const SE3& pose) const {
        NormalEquations equations;
        for (std::size_t i = 0; i < matches_.size(); ++i) {
            if (used_[i]) addMatch(matches_[i], pose, equations);
        }
        equations.H.triangularView<Eigen::StrictlyLower>() = equations.H.transpose();
        return equations;
    }

    void addMatch(const PointMatch& match, const SE3& pose, NormalEquations& equations) const {
        const Eigen::Vector3d p = pose * match.position;
        if (p.z() < nearest_depth_m) return;
        const Eigen::Vector3d r = residual(camera_, p, match.measurement);
        const RobustCost robust_r = robust(match, r.squaredNorm());
        const Eigen::Matrix3d Jp = residualJacobian(camera_, p, match.measurement);
        Eigen::Matrix<double, 3, 6> J;
        J.leftCols<3>() = Jp;
        for (int row = 0; row < 3; ++row) {
            J.row(row).tail<3>() = p.cross(Jp.row(row).transpose()).transpose();
        }
        for (int i = 0; i < 6; ++i) {
            const Eigen::Vector3d wJ = robust_r.weight * J.col(i);
            for (int j = i; j < 6; ++j) equations.H(i, j) += wJ.dot(J.col(j));
            equations.b(i) -= wJ.dot(r);
        }
        equations.cost += robust_r.cost;
    }

    void minimize() {
        double damping = 1e-6;
        NormalEquations equations = build(pose_);
        for (int step = 0; step < steps_a_round; ++step) {
            Matrix6d H = equations.H;
            H.diagonal() *= 1 + damping;
            H.diagonal().array() += 1e-9;
            const Vector6d delta = H.ldlt().solve(equations.b);
            if (!delta.allFinite()) return;
            const SE3 candidate = pose_.retract(delta);
            const NormalEquations there = build(candidate);
            if (there.cost <= equations.cost) {
                pose_ = candidate;
                equations = there;
                damping *= 0.1;
                if (delta.norm() < converged_step) return;
            } else {
                damping = std::max(damping * 100, 1e-3);
            }
        }
    }

    /** \return whether any match changed sides */
    bool reclassify() {
        bool changed = false;
        for (std::size_t i = 0; i < matches_.size(); ++i) {
            const Eigen::Vector3d p = pose_ * matches_[i].position;
            const Measurement& m = matches_[i].measurement;
            const bool fits =
                p.z() >= nearest_depth_m && residual(camera_, p, m).squaredNorm() <= chi2Limit(m);
            changed |= fits != used_[i];
            used_[i] = fits;
        }
        return changed;
    }

    const Camera& camera_;
    const std::vector<PointMatch>& matches_;
    SE3 pose_;
    std::vector<char> used_;
    PoseKernel kernel_;
};

}  // namespace

PoseSolution solvePose(const Camera& camera, const std::vector<PointMatch>& matches,
                       const SE3& initial, PoseKernel kernel) {
    return Solver(camera, matches, initial, kernel).solve();
}

}  // namespace rgbd_graphslam
