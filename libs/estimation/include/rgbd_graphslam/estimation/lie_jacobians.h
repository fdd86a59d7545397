/** Jacobians of SO(3), and the adjoint of SE(3). */
#pragma once
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** J with rotationExp(phi + d) = rotationExp(J d) * rotationExp(phi) to first order: the left
 *  Jacobian (Barfoot, "State Estimation for Robotics", 2017, eq. 7.77). The right one is that of
 *  -phi. */
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& phi);

/** Its inverse, |phi| < 2 pi (eq. 7.82): the derivative of rotationLog(rotationExp(w) * R) by w at
 *  0, given phi = rotationLog(R). */
Eigen::Matrix3d inverseLeftJacobian(const Eigen::Vector3d& phi);

/** A with T * pose.retract(d) = (T * pose).retract(A d) to first order: what a left perturbation
 *  becomes behind the transform T. */
Matrix6d adjoint(const SE3& T);

}  // namespace rgbd_graphslam
