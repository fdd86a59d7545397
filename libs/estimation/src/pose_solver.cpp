#include "rgbd_graphslam/estimation/pose_solver.h"

#include <Eigen/Cholesky>

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
    Solver(const std::vector<MountedCamera>& cameras, const std::vector<PointMatch>& matches,
           const SE3& initial, KernelShape kernel)
        : cameras_(cameras),
          matches_(matches),
          pose_(initial),
          used_(matches.size(), true),
          kernel_(kernel) {}

    PoseSolution solve() {
        for (int round = 0; round < rounds; ++round) {
            minimize();
            kernel_ = KernelShape::Huber;
            if (!reclassify() && round > 0) break;
        }
        PoseSolution solution;
        solution.T_body_world = pose_;
        solution.inlier.assign(used_.begin(), used_.end());
        for (const bool inlier : used_) solution.inliers += inlier;
        solution.information = build(pose_).H;
        return solution;
    }

  private:
    RobustCost robust(const PointMatch& match, double chi2) const {
        RobustCost robust = RobustKernel{kernel_, chi2Limit(match.measurement)}(chi2);
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
        const PointView view(cameras_[match.camera], pose, match.position);
        if (view.tooNear()) return;
        const Eigen::Vector3d r = view.residual(match.measurement);
        const RobustCost robust_r = robust(match, r.squaredNorm());
        const Eigen::Matrix<double, 3, 6> J =
            byPose(view.byBodyPoint(match.measurement), view.bodyPoint());
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
            const PointMatch& match = matches_[i];
            const bool fits =
                PointView(cameras_[match.camera], pose_, match.position).fits(match.measurement);
            changed |= fits != used_[i];
            used_[i] = fits;
        }
        return changed;
    }

    const std::vector<MountedCamera>& cameras_;
    const std::vector<PointMatch>& matches_;
    SE3 pose_;
    std::vector<char> used_;
    KernelShape kernel_;
};

}  // namespace

PoseSolution solvePose(const std::vector<MountedCamera>& cameras,
                       const std::vector<PointMatch>& matches, const SE3& initial,
                       KernelShape kernel) {
    return Solver(cameras, matches, initial, kernel).solve();
}

PoseSolution solvePose(const Camera& camera, const std::vector<PointMatch>& matches,
                       const SE3& initial, KernelShape kernel) {
    return solvePose({MountedCamera(camera)}, matches, initial, kernel);
}

}  // namespace rgbd_graphslam
