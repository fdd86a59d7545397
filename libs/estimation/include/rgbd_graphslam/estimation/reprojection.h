/** The measurement model of points: where a camera should see one, and how wrong it is. */
#pragma once
#include <Eigen/Core>

#include "rgbd_graphslam/estimation/mounted_camera.h"

namespace rgbd_graphslam {

/** A keypoint as the solvers see it: pixel and, when depth was read, inverse depth (which is what a
 *  disparity measures), each with the inverse of its standard deviation. */
struct Measurement {
    double u = 0, v = 0;
    double inverse_depth = 0;  // 1/m; unused when its weight is 0
    double weight_px = 1;      // 1/px
    double weight_depth = 0;   // m; 0 = no depth was read
};

/** 95 % of the chi-square distribution with two and three degrees of freedom. */
constexpr double chi2_pixel = 5.991, chi2_depth = 7.815;
inline double chi2Limit(const Measurement& m) {
    return m.weight_depth > 0 ? chi2_depth : chi2_pixel;
}

/** Nearest depth in front of a camera at which projecting makes sense, m. */
constexpr double nearest_depth_m = 0.05;

/** Whitened residual (predicted - measured) of a point in camera coordinates (m, z > 0): u, v and
 *  inverse depth, the last 0 where no depth was read. */
inline Eigen::Vector3d residual(const Camera& camera, const Eigen::Vector3d& p,
                                const Measurement& m) {
    const double inverse_z = 1 / p.z();
    const Eigen::Vector2d pixel = camera.project(p, inverse_z);
    return {m.weight_px * (pixel.x() - m.u), m.weight_px * (pixel.y() - m.v),
            m.weight_depth * (inverse_z - m.inverse_depth)};
}

/** Derivative of `residual` by the camera-frame point, 3x3. */
inline Eigen::Matrix3d residualJacobian(const Camera& camera, const Eigen::Vector3d& p,
                                        const Measurement& m) {
    const double inverse_z = 1 / p.z();
    Eigen::Matrix3d J;
    J << camera.projectionJacobian(p, m.weight_px), 0, 0, -m.weight_depth * (inverse_z * inverse_z);
    return J;
}

/** Derivatives by a left perturbation of the transform that gave the point `p`, from those by `p`.
 */
template <int rows>
[[gnu::always_inline]] inline Eigen::Matrix<double, rows, 6> byPose(
    const Eigen::Matrix<double, rows, 3>& by_point, const Eigen::Vector3d& p) {
    Eigen::Matrix<double, rows, 6> J;
    J.template leftCols<3>() = by_point;
    for (int row = 0; row < rows; ++row) {
        J.row(row).template tail<3>() = p.cross(by_point.row(row).transpose()).transpose();
    }
    return J;
}

/** A point of the world as a camera on the body sees it. All solvers evaluate their observations
 *  through this, inline. */
class PointView {
  public:
    PointView(const MountedCamera& camera, const SE3& T_body_world, const Eigen::Vector3d& point)
        : camera_(camera), p_body_(T_body_world * point), p_cam_(camera.fromBody(p_body_)) {}

    /** Then there is no residual. */
    bool tooNear() const { return p_cam_.z() < nearest_depth_m; }

    Eigen::Vector3d residual(const Measurement& m) const {
        return rgbd_graphslam::residual(camera_.camera(), p_cam_, m);
    }
    bool fits(const Measurement& m) const {
        return !tooNear() && residual(m).squaredNorm() <= chi2Limit(m);
    }
    /** Derivative of the residual by the point in the body's coordinates. */
    Eigen::Matrix3d byBodyPoint(const Measurement& m) const {
        Eigen::Matrix3d J = residualJacobian(camera_.camera(), p_cam_, m);
        camera_.changeToBody(J);
        return J;
    }
    const Eigen::Vector3d& bodyPoint() const { return p_body_; }

  private:
    const MountedCamera& camera_;
    Eigen::Vector3d p_body_, p_cam_;
};

}  // namespace rgbd_graphslam
