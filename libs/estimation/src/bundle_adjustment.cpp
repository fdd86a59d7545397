#include "rgbd_graphslam/estimation/bundle_adjustment.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/estimation/factor_evaluation.h"

namespace rgbd_graphslam {
namespace {

using Matrix63d = Eigen::Matrix<double, 6, 3>;
using Matrix36d = Eigen::Matrix<double, 3, 6>;

constexpr double least_relative_decrease = 1e-6;
constexpr double most_damping = 1e8;

PointView viewOf(const BundleObservation& o, const BundleProblem& problem) {
    return {problem.cameras[o.camera], problem.states.keyframes[o.keyframe].T_body_world,
            problem.states.points[o.point]};
}

template <class Block>
void damp(Block&& H, double damping) {
    H.diagonal() *= 1 + damping;
    H.diagonal().array() += 1e-9;
}

/** A point's own block and its links to the free keyframes that see it. */
struct PointBlock {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    int first_link = 0, links = 0;
};

struct Link {
    int keyframe;
    Matrix63d W;
};

/** Where the unknowns of free keyframes are in the equations: poses first, then the motions that
 *  factors name. */
class Layout {
  public:
    explicit Layout(const BundleProblem& problem)
        : motion_at_(static_cast<std::size_t>(problem.free_keyframes), -1),
          size_(tangentSize(StateKind::Pose) * problem.free_keyframes) {
        std::vector<bool> moving(motion_at_.size());
        for (const auto& factor : problem.factors) {
            for (const StateKey& key : factor->states()) {
                if (key.kind == StateKind::Point) throwOnPoint();
                if (key.kind == StateKind::Motion && isFree(key)) moving[key.index] = true;
            }
        }
        for (std::size_t k = 0; k < moving.size(); ++k) {
            if (moving[k])
                motion_at_[k] = std::exchange(size_, size_ + tangentSize(StateKind::Motion));
        }
    }

    int size() const { return size_; }
    /** Negative for what is not estimated. */
    int offset(const StateKey& key) const {
        if (!isFree(key)) return -1;
        return key.kind == StateKind::Pose ? 6 * key.index : motion_at_[key.index];
    }

  private:
    bool isFree(const StateKey& key) const {
        return key.index < static_cast<int>(motion_at_.size());
    }
    [[noreturn]] static void throwOnPoint() {
        throw Error("a factor of the windowed bundle adjustment names a point",
                    "give points observations, or use adjustBundleSparse");
    }

    std::vector<int> motion_at_;
    int size_;
};

class Adjuster {
  public:
    explicit Adjuster(BundleProblem& problem) : problem_(problem), layout_(problem) {}

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
        const Eigen::VectorXd steps = solveKeyframes(damping);
        const States old_states = problem_.states;
        if (steps.allFinite()) {
            movePoints(steps, damping);
            moveKeyframes(steps);
            const double reached = bundleCost(problem_);
            if (reached <= cost) {
                damping = std::max(damping * 0.1, 1e-9);
                return reached;
            }
        }
        problem_.states = old_states;
        damping *= 20;
        return HUGE_VAL;
    }

    void linearize() {
        pose_H_.assign(problem_.free_keyframes, Matrix6d::Zero());
        b_ = Eigen::VectorXd::Zero(layout_.size());
        blocks_.assign(problem_.states.points.size(), PointBlock{});
        links_.clear();
        int previous = -1;
        for (const BundleObservation& o : problem_.observations) {
            PointBlock& block = blocks_[o.point];
            if (o.point != previous) block.first_link = static_cast<int>(links_.size());
            previous = o.point;
            if (!o.outlier) addObservation(o, block);
        }
        if (problem_.factors.empty()) return;
        factor_H_ = Eigen::MatrixXd::Zero(layout_.size(), layout_.size());
        for (const auto& factor : problem_.factors) addFactor(*factor);
    }

    void addObservation(const BundleObservation& o, PointBlock& block) {
        const PointView view = viewOf(o, problem_);
        if (view.tooNear()) return;
        const Eigen::Vector3d r = view.residual(o.measurement);
        const double w = huber(r.squaredNorm(), chi2Limit(o.measurement)).weight;
        const Eigen::Matrix3d J_body_point = view.byBodyPoint(o.measurement);
        const Eigen::Matrix3d J_point =
            J_body_point * problem_.states.keyframes[o.keyframe].T_body_world.R;
        block.H.noalias() += w * J_point.transpose() * J_point;
        block.b.noalias() -= w * J_point.transpose() * r;
        if (o.keyframe >= problem_.free_keyframes) return;
        const Matrix36d J = byPose(J_body_point, view.bodyPoint());
        const Matrix63d wJt = w * J.transpose();
        pose_H_[o.keyframe].noalias() += wJt * J;
        b_.segment<6>(6 * o.keyframe).noalias() -= wJt * r;
        links_.push_back({o.keyframe, wJt * J_point});
        ++block.links;
    }

    /** Lower triangle only. */
    void addFactor(const Factor& factor) {
        FactorEvaluation evaluation(factor);
        if (!evaluation.evaluate(problem_.states, true)) return;
        const Eigen::VectorXd& r = evaluation.residual();
        const double w = factor.kernel()(r.squaredNorm()).weight;
        const auto& keys = evaluation.keys();
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const int row = layout_.offset(keys[i]);
            if (row < 0) continue;
            const Eigen::MatrixXd wJt = w * evaluation.jacobian(i).transpose();
            b_.segment(row, wJt.rows()) -= wJt * r;
            for (std::size_t j = 0; j < keys.size(); ++j) {
                const int column = layout_.offset(keys[j]);
                if (column < 0 || column > row) continue;
                const Eigen::MatrixXd J = evaluation.jacobian(j);
                factor_H_.block(row, column, wJt.rows(), J.cols()) += wJt * J;
            }
        }
    }

    static Eigen::Matrix3d dampedInverse(const PointBlock& block, double damping) {
        Eigen::Matrix3d H = block.H;
        damp(H, damping);
        return H.inverse();
    }

    /** The equations of the keyframes without the points; lower triangle. */
    Eigen::MatrixXd dampedKeyframeBlocks(double damping) const {
        Eigen::MatrixXd S = Eigen::MatrixXd::Zero(layout_.size(), layout_.size());
        if (!problem_.factors.empty()) S = factor_H_;
        for (int k = 0; k < problem_.free_keyframes; ++k) {
            S.block<6, 6>(6 * k, 6 * k) += pose_H_[k];
        }
        damp(S, damping);
        return S;
    }

    Eigen::VectorXd solveKeyframes(double damping) const {
        Eigen::MatrixXd S = dampedKeyframeBlocks(damping);
        Eigen::VectorXd b = b_;
        for (const PointBlock& block : blocks_) {
            if (block.links) eliminate(block, damping, S, b);
        }
        return S.selfadjointView<Eigen::Lower>().ldlt().solve(b);
    }

    /** Lower triangle only: links of a point are by rising keyframe where observations are. */
    void eliminate(const PointBlock& block, double damping, Eigen::MatrixXd& S,
                   Eigen::VectorXd& b) const {
        const Eigen::Matrix3d inverse = dampedInverse(block, damping);
        for (int i = 0; i < block.links; ++i) {
            const Link& row = links_[block.first_link + i];
            const Matrix63d Y = row.W * inverse;
            b.segment<6>(6 * row.keyframe).noalias() -= Y * block.b;
            for (int j = 0; j < block.links; ++j) {
                const Link& column = links_[block.first_link + j];
                if (column.keyframe > row.keyframe) continue;
                S.block<6, 6>(6 * row.keyframe, 6 * column.keyframe).noalias() -=
                    Y * column.W.transpose();
            }
        }
    }

    void movePoints(const Eigen::VectorXd& steps, double damping) {
        for (std::size_t p = 0; p < blocks_.size(); ++p) {
            const PointBlock& block = blocks_[p];
            if (block.H.isZero()) continue;
            Eigen::Vector3d b = block.b;
            for (int i = 0; i < block.links; ++i) {
                const Link& link = links_[block.first_link + i];
                b.noalias() -= link.W.transpose() * steps.segment<6>(6 * link.keyframe);
            }
            problem_.states.points[p] += dampedInverse(block, damping) * b;
        }
    }

    void moveKeyframes(const Eigen::VectorXd& steps) {
        for (int k = 0; k < problem_.free_keyframes; ++k) {
            KeyframeState& state = problem_.states.keyframes[k];
            state = state.retract(Vector6d(steps.segment<6>(6 * k)));
            const int motion = layout_.offset(motionKey(k));
            if (motion >= 0) state.motion = state.motion.retract(steps.segment<9>(motion));
        }
    }

    BundleProblem& problem_;
    const Layout layout_;
    std::vector<Matrix6d> pose_H_;
    /** Of the factors. */
    Eigen::MatrixXd factor_H_;
    Eigen::VectorXd b_;
    std::vector<PointBlock> blocks_;
    std::vector<Link> links_;
};

double costOf(const Factor& factor, const States& states) {
    FactorEvaluation evaluation(factor);
    if (!evaluation.evaluate(states, false)) return 0;
    return 0.5 * factor.kernel()(evaluation.residual().squaredNorm()).cost;
}

}  // namespace

double bundleCost(const BundleProblem& problem) {
    double cost = 0;
    for (const BundleObservation& o : problem.observations) {
        if (o.outlier) continue;
        const PointView view = viewOf(o, problem);
        if (view.tooNear()) continue;
        const double chi2 = view.residual(o.measurement).squaredNorm();
        cost += 0.5 * huber(chi2, chi2Limit(o.measurement)).cost;
    }
    for (const auto& factor : problem.factors) cost += costOf(*factor, problem.states);
    return cost;
}

void markBundleOutliers(BundleProblem& problem) {
    for (BundleObservation& o : problem.observations) {
        o.outlier = !viewOf(o, problem).fits(o.measurement);
    }
}

BundleSummary adjustBundle(BundleProblem& problem, int max_iterations, bool mark_outliers) {
    return Adjuster(problem).run(max_iterations, mark_outliers);
}

}  // namespace rgbd_graphslam
