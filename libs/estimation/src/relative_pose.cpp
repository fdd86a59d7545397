#include "rgbd_graphslam/estimation/relative_pose.h"

#include "rgbd_graphslam/estimation/lie_jacobians.h"
#include "rgbd_graphslam/estimation/whitening.h"

namespace rgbd_graphslam {

Vector6d relativePoseError(const SE3& predicted, const SE3& measured) {
    const SE3 error = measured.inverse() * predicted;
    Vector6d tangent;
    tangent << error.t, rotationLog(error.R);
    return tangent;
}

RelativePose::RelativePose(int from, int to, const SE3& T_from_to, const Matrix6d& information,
                           const RobustKernel& kernel)
    : from_(from),
      to_(to),
      T_from_to_(T_from_to),
      whitening_(
          whiteningOf(information, "edge " + std::to_string(from) + " - " + std::to_string(to))),
      kernel_(kernel) {}

bool RelativePose::linearize(const StateBlocks& states, Linearization& out) const {
    const SE3 predicted = states.pose(0) * states.pose(1).inverse();
    const Vector6d error = relativePoseError(predicted, T_from_to_);
    out.setResidual(Vector6d(whitening_ * error));
    if (!out.wantsJacobians()) return true;
    const Eigen::Matrix3d R_to_from = T_from_to_.R.transpose();
    const Eigen::Matrix3d by_log = inverseLeftJacobian(error.tail<3>());
    Matrix6d by_from, by_to;
    by_from << R_to_from, -R_to_from * skew(predicted.t), Eigen::Matrix3d::Zero(),
        by_log * R_to_from;
    by_to << -R_to_from * predicted.R, Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(),
        -by_log.transpose();
    out.setJacobian(0, Matrix6d(whitening_ * by_from));
    out.setJacobian(1, Matrix6d(whitening_ * by_to));
    return true;
}

}  // namespace rgbd_graphslam
