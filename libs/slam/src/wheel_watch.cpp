#include "wheel_watch.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

/** 99.9 % of chi-square with three degrees of freedom. */
constexpr double slip_limit = 16.3;
constexpr double forgetting = 0.03, least_excess = 0.3, largest_excess = 60;
/** Larger squared residuals count as this. */
constexpr double largest_chi2 = 12;
constexpr double largest_scale = 1.5;
/** Shorter ways say nothing of the radius. */
constexpr double least_way_m = 0.03;
/** Variance that the radius gains per meter: tires wear and loads change. */
constexpr double scale_walk = 1e-7;

}  // namespace

WheelIncrement WheelWatch::corrected(WheelIncrement increment, double blind_way_m) const {
    increment.T_from_to.x *= scale_;
    increment.T_from_to.y *= scale_;
    const double way = std::hypot(increment.T_from_to.x, increment.T_from_to.y);
    const Eigen::Vector3d grown(std::sqrt(way_excess_), std::sqrt(way_excess_),
                                std::sqrt(turn_excess_));
    increment.covariance = grown.asDiagonal() * increment.covariance * grown.asDiagonal();
    increment.covariance(0, 0) += scale_variance_ * way * (way + 2 * blind_way_m);
    return increment;
}

bool WheelWatch::slipped(const Eigen::Vector3d& residual, const Eigen::Matrix3d& covariance) {
    chi2_ = residual.dot(covariance.llt().solve(residual));
    way_chi2_ = residual.x() * residual.x() / covariance(0, 0);
    turn_chi2_ = residual.z() * residual.z() / covariance(2, 2);
    return !(chi2_ <= slip_limit);
}

void WheelWatch::learn(const WheelIncrement& raw, const PlanarPose& seen, double sigma_m) {
    const auto adapt = [](double chi2, double& excess) {
        excess = std::clamp(excess * (1 + forgetting * (std::min(chi2, largest_chi2) - 1)),
                            least_excess, largest_excess);
    };
    adapt(way_chi2_, way_excess_);
    adapt(turn_chi2_, turn_excess_);
    const double way = raw.T_from_to.x;
    if (std::abs(way) < least_way_m) return;
    const double variance = (sigma_m * sigma_m + way_excess_ * raw.covariance(0, 0)) / (way * way);
    scale_variance_ += scale_walk * std::abs(way);
    const double gain = scale_variance_ / (scale_variance_ + variance);
    scale_ = std::clamp(scale_ + gain * (seen.x / way - scale_), 1 / largest_scale, largest_scale);
    scale_variance_ *= 1 - gain;
}

double WheelWatch::scaleSigma() const {
    return std::sqrt(scale_variance_);
}

void WheelWatch::save(ByteWriter& out) const {
    for (const double number :
         {scale_, scale_variance_, way_excess_, turn_excess_, chi2_, way_chi2_, turn_chi2_}) {
        out.put(number);
    }
}

void WheelWatch::load(ByteReader& in) {
    for (double* number : {&scale_, &scale_variance_, &way_excess_, &turn_excess_, &chi2_,
                           &way_chi2_, &turn_chi2_}) {
        *number = getFinite(in);
    }
}

}  // namespace rgbd_graphslam
