#include "pose_uncertainty.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

/** Standard deviations over those of independent errors. */
constexpr double calibration = 2.0;
/** What all matches of a frame err alike. */
constexpr PoseSpread common_error{0.002, 0.001};
/** Growth from keyframe to keyframe: variance per meter of way (a radian counts as one). */
constexpr double walk_m2 = 4e-6, walk_rad2 = 1e-6;
/** Where links are so uncertain, each adds its own variance to the map's. */
constexpr PoseSpread poor_link{0.008, 0.004};
constexpr double no_information = 1e-6;

double square(double x) {
    return x * x;
}

}  // namespace

Matrix6d covarianceOf(const PoseSpread& spread) {
    Matrix6d covariance = Matrix6d::Zero();
    covariance.diagonal().head<3>().setConstant(square(spread.m));
    covariance.diagonal().tail<3>().setConstant(square(spread.rad));
    return covariance;
}

Matrix6d covarianceAgainstMap(const LocatedFrame& located) {
    Matrix6d information = located.information;
    information.diagonal().array() += no_information;
    return square(calibration) * information.inverse();
}

PoseSpread weakestDirection(const Matrix6d& covariance) {
    const auto largest = [](const Eigen::Matrix3d& block) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(block, Eigen::EigenvaluesOnly);
        return std::sqrt(std::max(0.0, solver.eigenvalues()[2]));
    };
    return {largest(covariance.topLeftCorner<3, 3>()),
            largest(covariance.bottomRightCorner<3, 3>())};
}

void MapUncertainty::add(int reference, const SE3& T_reference_keyframe, const KeyframeLink& link) {
    Variance variance;
    if (reference != no_reference) variance = variances_[reference];
    const double way = T_reference_keyframe.t.norm() + T_reference_keyframe.angle();
    const bool reckoned = link.by == KeyframeLink::By::DeadReckoning;
    const auto growth = [&](double sigma, double poor) {
        return square(sigma) * (reckoned ? 1 : square(sigma / poor));
    };
    variance.m2 += walk_m2 * way + growth(link.spread.m, poor_link.m);
    variance.rad2 += walk_rad2 * way + growth(link.spread.rad, poor_link.rad);
    variances_.push_back(variance);
}

void MapUncertainty::closeLoop(int from, int to) {
    const Variance known = variances_[from];
    variances_[to].m2 = std::min(variances_[to].m2, known.m2);
    variances_[to].rad2 = std::min(variances_[to].rad2, known.rad2);
}

Matrix6d MapUncertainty::inWorld(const Matrix6d& against_map, int reference_keyframe) const {
    const Matrix6d alike = covarianceOf(common_error);
    if (variances_.empty()) return against_map + alike;
    const Variance& variance = variances_[reference_keyframe];
    return against_map + alike + covarianceOf({std::sqrt(variance.m2), std::sqrt(variance.rad2)});
}

void MapUncertainty::save(ByteWriter& out) const {
    for (const Variance& variance : variances_) {
        out.put(variance.m2);
        out.put(variance.rad2);
    }
}

void MapUncertainty::load(ByteReader& in, std::size_t keyframes) {
    variances_.resize(keyframes);
    for (Variance& variance : variances_) {
        variance.m2 = std::max(0.0, getFinite(in));
        variance.rad2 = std::max(0.0, getFinite(in));
    }
}

}  // namespace rgbd_graphslam
