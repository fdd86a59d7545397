#include "rgbd_graphslam/metrics/alignment.h"

#include <cmath>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr double smallest_extent_m = 1e-9;

bool isOnePoint(const Eigen::Matrix3Xd& points) {
    const Eigen::Vector3d first = points.col(0);
    return (points.colwise() - first).cwiseAbs().maxCoeff() < smallest_extent_m;
}

}  // namespace

Similarity alignPoints(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to,
                       AlignmentScale scale) {
    if (from.cols() < 2) throw Error("an alignment needs two points or more");
    const bool fitted = scale == AlignmentScale::Fitted;
    if (fitted && isOnePoint(from)) throw Error("no scale fits a trajectory that does not move");
    const Eigen::Matrix4d T = Eigen::umeyama(from, to, fitted);
    Similarity result;
    result.scale = fitted ? T.block<3, 1>(0, 0).norm() : 1.0;
    result.motion = SE3(Eigen::Matrix3d(T.block<3, 3>(0, 0) / result.scale), T.block<3, 1>(0, 3));
    return result;
}

}  // namespace rgbd_graphslam
