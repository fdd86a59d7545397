#include "pose_uncertainty.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/estimation/lie_jacobians.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

/** What all matches of a frame err alike. */
constexpr PoseSpread common_error{0.001, 0.0005};
/** Systematic error as a share of the way from the start: of any camera, and of one whose halves
 *  disagree by one standard deviation more than independent errors do. */
constexpr double least_share = 0.002, share_per_disagreement = 0.02;
constexpr std::size_t most_disagreements = 31;
constexpr std::size_t fewest_of_a_half = 20;
constexpr double no_information = 1e-6;

double square(double x) {
    return x * x;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Matrix6d inverted(Matrix6d information) {
    information.diagonal().array() += no_information;
    return information.inverse();
}

/** A radian is what it does to points two meters away. */
double amount(const Matrix6d& covariance) {
    return covariance.diagonal().head<3>().sum() + 4 * covariance.diagonal().tail<3>().sum();
}

/** \param value by which matches are told apart, one per match */
std::optional<double> disagreement(const std::vector<PointMatch>& matches,
                                   const std::vector<double>& value, const RigCameras& cameras,
                                   const SE3& T_cam_world) {
    const double middle = median(value);
    std::vector<PointMatch> halves[2];
    for (std::size_t i = 0; i < matches.size(); ++i)
        halves[value[i] < middle].push_back(matches[i]);
    PoseSolution solutions[2];
    for (int h = 0; h < 2; ++h) {
        if (halves[h].size() < fewest_of_a_half) return std::nullopt;
        solutions[h] =
            solvePose(cameras.mounted(), halves[h], T_cam_world, KernelShape::GemanMcClure);
        if (2 * solutions[h].inliers < static_cast<int>(halves[h].size())) return std::nullopt;
    }
    const Vector6d off = solutions[0].T_body_world.minus(solutions[1].T_body_world);
    const Matrix6d covariance =
        inverted(solutions[0].information) + inverted(solutions[1].information);
    return off.dot(covariance.ldlt().solve(off)) / 6;
}

}  // namespace

Matrix6d covarianceOf(const PoseSpread& spread) {
    Matrix6d covariance = Matrix6d::Zero();
    covariance.diagonal().head<3>().setConstant(square(spread.m));
    covariance.diagonal().tail<3>().setConstant(square(spread.rad));
    return covariance;
}

Matrix6d covarianceAgainstMap(const LocatedFrame& located) {
    return inverted(located.information);
}

PoseSpread weakestDirection(const Matrix6d& covariance) {
    const auto largest = [](const Eigen::Matrix3d& block) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(block, Eigen::EigenvaluesOnly);
        return std::sqrt(std::max(0.0, solver.eigenvalues()[2]));
    };
    return {largest(covariance.topLeftCorner<3, 3>()),
            largest(covariance.bottomRightCorner<3, 3>())};
}

std::optional<double> disagreementOfHalves(const std::vector<PointMatch>& matches,
                                           const RigCameras& cameras, const LocatedFrame& located) {
    if (matches.size() < 2 * fewest_of_a_half) return std::nullopt;
    std::vector<double> columns, rows, depths;
    for (const PointMatch& match : matches) {
        columns.push_back(match.measurement.u);
        rows.push_back(match.measurement.v);
        depths.push_back((located.T_cam_world * match.position).z());
    }
    double sum = 0;
    int halvings = 0;
    for (const auto* value : {&columns, &rows, &depths}) {
        const auto found = disagreement(matches, *value, cameras, located.T_cam_world);
        if (!found) continue;
        sum += *found;
        ++halvings;
    }
    if (halvings == 0) return std::nullopt;
    return sum / halvings;
}

void MapUncertainty::restore(std::size_t keyframes) {
    covariances_.assign(keyframes, Matrix6d::Zero());
}

void MapUncertainty::add(const std::vector<KeyframeTie>& ties) {
    std::optional<Matrix6d> best;
    for (const KeyframeTie& tie : ties) {
        const Matrix6d by = adjoint(tie.T_new_keyframe);
        const Matrix6d covariance =
            by * covariances_[tie.keyframe] * by.transpose() + tie.covariance;
        if (!best || amount(covariance) < amount(*best)) best = covariance;
    }
    covariances_.push_back(best.value_or(Matrix6d::Zero()));
}

void MapUncertainty::closeLoop(int from, int to, const SE3& T_from_to) {
    const Matrix6d by = adjoint(T_from_to.inverse());
    const Matrix6d known = by * covariances_[from] * by.transpose();
    if (amount(known) < amount(covariances_[to])) covariances_[to] = known;
}

void MapUncertainty::note(const std::optional<double>& disagreement) {
    if (!disagreement || !std::isfinite(*disagreement)) return;
    if (disagreements_.size() == most_disagreements) disagreements_.pop_front();
    disagreements_.push_back(*disagreement);
}

double MapUncertainty::scale() const {
    if (disagreements_.empty()) return 1;
    return std::max(1.0, median({disagreements_.begin(), disagreements_.end()}));
}

Matrix6d MapUncertainty::inWorld(const Matrix6d& against_map, int reference_keyframe,
                                 const SE3& T_cam_reference, const SE3& T_cam_origin) const {
    Matrix6d covariance = against_map + covarianceOf(common_error);
    if (covariances_.empty()) return covariance;
    const Matrix6d by = adjoint(T_cam_reference);
    covariance += by * covariances_[reference_keyframe] * by.transpose();
    const double share = least_share + share_per_disagreement * std::sqrt(scale() - 1);
    return covariance + covarianceOf({share * T_cam_origin.t.norm(), share * T_cam_origin.angle()});
}

void MapUncertainty::save(ByteWriter& out) const {
    for (const Matrix6d& covariance : covariances_)
        for (int i = 0; i < covariance.size(); ++i) out.put(covariance.data()[i]);
    out.putCount(disagreements_.size());
    for (const double disagreement : disagreements_) out.put(disagreement);
}

void MapUncertainty::load(ByteReader& in, std::size_t keyframes) {
    covariances_.assign(keyframes, Matrix6d::Zero());
    for (Matrix6d& covariance : covariances_)
        for (int i = 0; i < covariance.size(); ++i) covariance.data()[i] = getFinite(in);
    disagreements_.resize(in.getCount(sizeof(double)));
    for (double& disagreement : disagreements_) disagreement = getFinite(in);
}

}  // namespace rgbd_graphslam
