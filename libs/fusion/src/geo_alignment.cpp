#include "rgbd_graphslam/fusion/geo_alignment.h"

#include <cmath>

#include "rgbd_graphslam/estimation/robust_kernel.h"

namespace rgbd_graphslam {
namespace {

struct Means {
    Eigen::Vector3d map = Eigen::Vector3d::Zero(), enu = Eigen::Vector3d::Zero();
};

Means weightedMeans(const std::vector<PlacePair>& pairs, const std::vector<double>& weights) {
    Means means;
    double sum = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        means.map += weights[i] * pairs[i].map;
        means.enu += weights[i] * pairs[i].enu;
        sum += weights[i];
    }
    means.map /= sum;
    means.enu /= sum;
    return means;
}

/** Closed form in the plane. */
SE3 fitted(const std::vector<PlacePair>& pairs, const std::vector<double>& weights) {
    const Means means = weightedMeans(pairs, weights);
    double cosine = 0, sine = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Eigen::Vector3d p = pairs[i].map - means.map, q = pairs[i].enu - means.enu;
        cosine += weights[i] * (p.x() * q.x() + p.y() * q.y());
        sine += weights[i] * (p.x() * q.y() - p.y() * q.x());
    }
    const Eigen::Matrix3d R = rotationExp({0, 0, std::atan2(sine, cosine)});
    return {R, means.enu - R * means.map};
}

}  // namespace

std::optional<SE3> alignLevel(const std::vector<PlacePair>& pairs, double least_extent_m) {
    constexpr int rounds = 20;
    constexpr double limit = 9;
    if (pairs.size() < 3) return std::nullopt;
    std::vector<double> weights;
    for (const PlacePair& pair : pairs) weights.push_back(1 / (pair.sigma_m * pair.sigma_m));
    const Eigen::Vector3d middle = weightedMeans(pairs, weights).map;
    double extent_m = 0;
    for (const PlacePair& pair : pairs) {
        extent_m = std::max(extent_m, (pair.map - middle).head<2>().norm());
    }
    if (extent_m < least_extent_m) return std::nullopt;
    SE3 T = fitted(pairs, weights);
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const double variance = pairs[i].sigma_m * pairs[i].sigma_m;
            const double chi2 =
                (T * pairs[i].map - pairs[i].enu).head<2>().squaredNorm() / variance;
            weights[i] = cauchy(chi2, limit).weight / variance;
        }
        T = fitted(pairs, weights);
    }
    return T;
}

}  // namespace rgbd_graphslam
