#include "epipolar_geometry.h"

namespace rgbd_graphslam {

EpipolarGeometry::EpipolarGeometry(const CameraModel& a, const CameraModel& b, const SE3& T_b_a)
    : a_(a), b_(b) {
    const auto raysOf = [](const CameraModel& camera) -> Eigen::Matrix3d {
        if (camera.hasDistortion()) return Eigen::Matrix3d::Identity();
        return camera.inverseMatrix();
    };
    line_from_ray_ = raysOf(b).transpose() * skew(T_b_a.t) * T_b_a.R * raysOf(a);
}

Eigen::Vector3d EpipolarGeometry::lineOf(const Keypoint& a) const {
    if (a_.hasDistortion()) return line_from_ray_ * a_.bearing({a.u, a.v});
    return line_from_ray_ * Eigen::Vector3d(a.u, a.v, 1);
}

double EpipolarGeometry::chi2(const Eigen::Vector3d& line, const Keypoint& b,
                              double sigma_px) const {
    if (b_.hasDistortion()) {
        const double angle = line.normalized().dot(b_.bearing({b.u, b.v}));
        const double distance = angle * b_.pixelsPerRadian().x() / sigma_px;
        return distance * distance;
    }
    const double distance = line.x() * b.u + line.y() * b.v + line.z();
    return distance * distance / (line.head<2>().squaredNorm() * sigma_px * sigma_px);
}

}  // namespace rgbd_graphslam
