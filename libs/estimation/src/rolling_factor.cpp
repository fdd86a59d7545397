#include "rgbd_graphslam/estimation/rolling_factor.h"

#include "rgbd_graphslam/estimation/lie_jacobians.h"

namespace rgbd_graphslam {

bool RollingFactor::linearize(const StateBlocks& states, Linearization& out) const {
    using Row = Eigen::Matrix<double, 1, 6>;
    const SE3 T_from_to = T_base_body_ * states.pose(0) * (T_base_body_ * states.pose(1)).inverse();
    out.setResidual(Eigen::Matrix<double, 1, 1>(T_from_to.t.z() / sigma_m_));
    if (!out.wantsJacobians()) return true;
    Row by_from, by_to;
    by_from << 0, 0, 1, -skew(T_from_to.t).row(2);
    by_to << -T_from_to.R.row(2), 0, 0, 0;
    const Matrix6d by_body = adjoint(T_base_body_) / sigma_m_;
    out.setJacobian(0, Row(by_from * by_body));
    out.setJacobian(1, Row(by_to * by_body));
    return true;
}

}  // namespace rgbd_graphslam
