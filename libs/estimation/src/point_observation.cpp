#include "rgbd_graphslam/estimation/point_observation.h"

namespace rgbd_graphslam {

bool PointObservation::linearize(const StateBlocks& states, Linearization& out) const {
    const SE3 T_body_world = states.pose(0);
    const PointView view(*camera_, T_body_world, states.point(1));
    if (view.tooNear()) return false;
    out.setResidual(view.residual(measurement_));
    if (!out.wantsJacobians()) return true;
    const Eigen::Matrix3d by_body_point = view.byBodyPoint(measurement_);
    out.setJacobian(0, byPose(by_body_point, view.bodyPoint()));
    out.setJacobian(1, Eigen::Matrix3d(by_body_point * T_body_world.R));
    return true;
}

}  // namespace rgbd_graphslam
