#include "rgbd_graphslam/laser/scan_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "rgbd_graphslam/estimation/robust_kernel.h"

namespace rgbd_graphslam {
namespace {

/** Of (x, y, yaw) in the scan's frame. */
struct NormalEquations {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    std::size_t used = 0, inliers = 0, asked = 0;
    double squares = 0;
};

/** \param kernel_m residual at which a point keeps half of its weight */
NormalEquations accumulate(const PointIndex& reference, const std::vector<ScanPoint>& scan,
                           const PlanarPose& pose, double gate_m, double inlier_m, double sigma_m) {
    NormalEquations sums;
    const double limit = std::pow(inlier_m / sigma_m, 2);
    for (const auto& [p, normal] : scan) {
        if (normal.isZero()) continue;
        ++sums.asked;
        const Eigen::Vector2d in_ref = transformed(pose, p);
        const ScanPoint* near = reference.nearest(in_ref, rotated(pose.yaw, normal), gate_m);
        if (!near) continue;
        const double residual = near->normal.dot(in_ref - near->p);
        const Eigen::Vector2d n = rotated(-pose.yaw, near->normal);
        const Eigen::Vector3d J(n.x(), n.y(), n.y() * p.x() - n.x() * p.y());
        const double chi2 = std::pow(residual / sigma_m, 2);
        const double weight = cauchy(chi2, limit).weight / (sigma_m * sigma_m);
        sums.H += weight * J * J.transpose();
        sums.b -= weight * residual * J;
        ++sums.used;
        if (std::abs(residual) > inlier_m) continue;
        ++sums.inliers;
        sums.squares += residual * residual;
    }
    return sums;
}

void addPrior(const PlanarPrior& prior, const PlanarPose& pose, Eigen::Matrix3d& H,
              Eigen::Vector3d& b) {
    const PlanarPose off = prior.mean.inverse() * pose;
    const Eigen::Vector2d t = rotated(-off.yaw, positionOf(off));  // in the scan's frame
    H += prior.information;
    b -= prior.information * Eigen::Vector3d(t.x(), t.y(), wrapped(off.yaw));
}

bool isConstrained(const Eigen::Matrix3d& H) {
    constexpr double least_share = 1e-4;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(H, Eigen::EigenvaluesOnly);
    return axes.eigenvalues()(0) > least_share * axes.eigenvalues()(2);
}

}  // namespace

std::optional<ScanAlignment> alignScan(const PointIndex& reference,
                                       const std::vector<ScanPoint>& scan, const PlanarPose& guess,
                                       const std::optional<PlanarPrior>& prior,
                                       const AlignmentOptions& options) {
    constexpr std::size_t least_points = 5;
    constexpr double still = 1e-5;
    PlanarPose pose = guess;
    NormalEquations sums;
    bool settled = false;
    for (int i = 0; i <= options.iterations; ++i) {
        const double share = std::min(1.0, 2.0 * i / options.iterations);
        const double gate_m =
            options.first_gate_m + share * (options.last_gate_m - options.first_gate_m);
        sums = accumulate(reference, scan, pose, gate_m, 2 * options.sigma_m, options.sigma_m);
        if (sums.used < least_points || settled || i == options.iterations) break;
        Eigen::Matrix3d H = sums.H;
        Eigen::Vector3d b = sums.b;
        if (prior) addPrior(*prior, pose, H, b);
        if (!isConstrained(H)) return std::nullopt;
        const Eigen::Vector3d step = H.ldlt().solve(b);
        pose = pose * PlanarPose{step.x(), step.y(), step.z()};
        pose.yaw = wrapped(pose.yaw);
        settled = share >= 1 && step.norm() < still;
    }
    if (sums.used < least_points || sums.inliers == 0) return std::nullopt;
    const auto inliers = static_cast<double>(sums.inliers);
    return ScanAlignment{pose, sums.H, inliers / static_cast<double>(sums.asked), sums.inliers,
                         std::sqrt(sums.squares / inliers)};
}

}  // namespace rgbd_graphslam
