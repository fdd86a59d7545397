#include "rgbd_graphslam/slam/bundle_adjustment.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "rgbd_graphslam/slam/robust_kernel.h"

namespace rgbd_graphslam {
namespace {

using Matrix63d = Eigen::Matrix<double, 6, 3>;
using Matrix36d = Eigen::Matrix<double, 3, 6>;

constexpr double least_relative_decrease = 1e-6;
constexpr double most_damping = 1e8;

/** A point's own block and its links to the free cameras that see it. */
struct PointBlock {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    int first_link = 0, links = 0;
};

struct Link {
    int camera;
    Matrix63d W;
};

class Adjuster {
  public:
    explicit Adjuster(BundleProblem& problem) : problem_(problem) {}

    BundleSummary run(int max_iterations, bool mark_outliers) {
        BundleSummary summary;
        double cost = bundleCost(problem_);
        summary.initial_cost = cost;
        double damping = 1e-4;
        for (int i = 0; i < max_iterations && damping < most_damping; ++i, ++summary.iterations) {
            if (mark_outliers && i == max_iterations / 2) {
                markBundleOutliers(problem_);
                cost = bundleCost(problem_);
            }
            const double reached = step(cost, damping);
            const bool settled = reached <= cost && cost - reached < least_relative_decrease * cost;
            cost = std::min(cost, reached);
            if (settled && (!mark_outliers || i >= max_iterations / 2)) break;
        }
        summary.final_cost = cost;
        return summary;
    }

  private:
    /** Tries one damped step and takes it when the cost falls. \return the cost of the step */
    double step(double cost, double& damping) {
        linearize();
        const Eigen::VectorXd camera_steps = solveCameras(damping);
        const std::vector<SE3> old_poses = problem_.T_cam_world;
        const std::vector<Eigen::Vector3d> old_points = problem_.points;
        if (camera_steps.allFinite()) {
            movePoints(camera_steps, damping);
            for (int c = 0; c < problem_.free_cameras; ++c) {
                problem_.T_cam_world[c] = old_poses[c].retract(camera_steps.segment<6>(6 * c));
            }
            const double reached = bundleCost(problem_);
            if (reached <= cost) {
                damping = std::max(damping * 0.1, 1e-9);
                return reached;
            }
        }
        problem_.T_cam_world = old_poses;
        problem_.points = old_points;
        damping *= 20;
        return HUGE_VAL;
    }

    void linearize() {
        camera_H_.assign(problem_.free_cameras, Matrix6d::Zero());
        camera_b_ = Eigen::VectorXd::Zero(6 * problem_.free_cameras);
        blocks_.assign(problem_.points.size(), PointBlock{});
        links_.clear();
        int previous = -1;
        for (const BundleObservation& o : problem_.observations) {
            PointBlock& block = blocks_[o.point];
            if (o.point != previous) block.first_link = static_cast<int>(links_.size());
            previous = o.point;
            if (!o.outlier) addObservation(o, block);
        }
    }

    void addObservation(const BundleObservation& o, PointBlock& block) {
        const SE3& pose = problem_.T_cam_world[o.camera];
        const Eigen::Vector3d p = pose * problem_.points[o.point];
        if (p.z() < nearest_depth_m) return;
        const Eigen::Vector3d r = residual(problem_.camera, p, o.measurement);
        const double w = huber(r.squaredNorm(), chi2Limit(o.measurement)).weight;
        const Eigen::Matrix3d J_cam_point = residualJacobian(problem_.camera, p, o.measurement);
        const Eigen::Matrix3d J_point = J_cam_point * pose.R;
        block.H.noalias() += w * J_point.transpose() * J_point;
        block.b.noalias() -= w * J_point.transpose() * r;
        if (o.camera >= problem_.free_cameras) return;
        Matrix36d J;
        J.leftCols<3>() = J_cam_point;
        for (int row = 0; row < 3; ++row) {
            J.row(row).tail<3>() = p.cross(J_cam_point.row(row).transpose()).transpose();
        }
        const Matrix63d wJt = w * J.transpose();
        camera_H_[o.camera].noalias() += wJt * J;
        camera_b_.segment<6>(6 * o.camera).noalias() -= wJt * r;
        links_.push_back({o.camera, wJt * J_point});
        ++block.links;
    }

    static Eigen::Matrix3d dampedInverse(const PointBlock& block, double damping) {
        Eigen::Matrix3d H = block.H;
        H.diagonal() *= 1 + damping;
        H.diagonal().array() += 1e-9;
        return H.inverse();
    }

    Eigen::VectorXd solveCameras(double damping) const {
        const int n = 6 * problem_.free_cameras;
        Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n, n);
        Eigen::VectorXd b = camera_b_;
        for (int c = 0; c < problem_.free_cameras; ++c) {
            Matrix6d H = camera_H_[c];
            H.diagonal() *= 1 + damping;
            H.diagonal().array() += 1e-9;
            S.block<6, 6>(6 * c, 6 * c) = H;
        }
        for (const PointBlock& block : blocks_) {
            if (block.links) eliminate(block, damping, S, b);
        }
        return S.selfadjointView<Eigen::Lower>().ldlt().solve(b);
    }

    /** Lower triangle only: links of a point are by rising camera where observations are. */
    void eliminate(const PointBlock& block, double damping, Eigen::MatrixXd& S,
                   Eigen::VectorXd& b) const {
        const Eigen::Matrix3d inverse = dampedInverse(block, damping);
        for (int i = 0; i < block.links; ++i) {
            const Link& row = links_[block.first_link + i];
            const Matrix63d Y = row.W * inverse;
            b.segment<6>(6 * row.camera).noalias() -= Y * block.b;
            for (int j = 0; j < block.links; ++j) {
                const Link& column = links_[block.first_link + j];
                if (column.camera > row.camera) continue;
                S.block<6, 6>(6 * row.camera, 6 * column.camera).noalias() -=
                    Y * column.W.transpose();
            }
        }
    }

    void movePoints(const Eigen::VectorXd& camera_steps, double damping) {
        for (std::size_t p = 0; p < blocks_.size(); ++p) {
            const PointBlock& block = blocks_[p];
            if (block.H.isZero()) continue;
            Eigen::Vector3d b = block.b;
            for (int i = 0; i < block.links; ++i) {
                const Link& link = links_[block.first_link + i];
                b.noalias() -= link.W.transpose() * camera_steps.segment<6>(6 * link.camera);
            }
            problem_.points[p] += dampedInverse(block, damping) * b;
        }
    }

    BundleProblem& problem_;
    std::vector<Matrix6d> camera_H_;
    Eigen::VectorXd camera_b_;
    std::vector<PointBlock> blocks_;
    std::vector<Link> links_;
};

}  // namespace

double bundleCost(const BundleProblem& problem) {
    double cost = 0;
    for (const BundleObservation& o : problem.observations) {
        if (o.outlier) continue;
        const Eigen::Vector3d p = problem.T_cam_world[o.camera] * problem.points[o.point];
        if (p.z() < nearest_depth_m) continue;
        const double chi2 = residual(problem.camera, p, o.measurement).squaredNorm();
        cost += 0.5 * huber(chi2, chi2Limit(o.measurement)).cost;
    }
    return cost;
}

void markBundleOutliers(BundleProblem& problem) {
    for (BundleObservation& o : problem.observations) {
        const Eigen::Vector3d p = problem.T_cam_world[o.camera] * problem.points[o.point];
        o.outlier =
            p.z() < nearest_depth_m ||
            residual(problem.camera, p, o.measurement).squaredNorm() > chi2Limit(o.measurement);
    }
}

BundleSummary adjustBundle(BundleProblem& problem, int max_iterations, bool mark_outliers) {
    return Adjuster(problem).run(max_iterations, mark_outliers);
}

}  // namespace rgbd_graphslam
