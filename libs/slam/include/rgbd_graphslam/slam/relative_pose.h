/** The residual of a relative pose measurement. */
#pragma once
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** How far two poses are from a measurement between them: the tangent vector (m, rad) of
 *  measured^-1 * T_world_from^-1 * T_world_to.
 *  \param jacobian_to if given, the derivative with respect to a left perturbation of `T_world_to`;
 *         that with respect to `T_world_from` is its negative, since moving both alike changes
 *         nothing */
Vector6d relativePoseResidual(const SE3& T_world_from, const SE3& T_world_to,
                              const SE3& measured_from_to, Matrix6d* jacobian_to = nullptr);

/** Derivative of rotationLog(rotationExp(w) * R) with respect to w at 0, given
 *  phi = rotationLog(R), |phi| < 2 pi: the inverse left Jacobian of SO(3) (Barfoot, "State
 *  Estimation for Robotics", 2017, eq. 7.82). */
Eigen::Matrix3d inverseLeftJacobian(const Eigen::Vector3d& phi);

}  // namespace rgbd_graphslam
