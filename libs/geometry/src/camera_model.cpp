#include "rgbd_graphslam/geometry/camera_model.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace rgbd_graphslam {

bool operator==(const Intrinsics& a, const Intrinsics& b) {
    return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
           a.cx == b.cx && a.cy == b.cy && a.lens == b.lens;
}

CameraModel::CameraModel(const Intrinsics& intrinsics)
    : width(intrinsics.width),
      height(intrinsics.height),
      in_(intrinsics),
      distorts_(intrinsics.hasDistortion()) {}

Intrinsics CameraModel::intrinsics() const {
    Intrinsics all = in_;
    all.width = width;
    all.height = height;
    return all;
}

Eigen::Vector2d CameraModel::throughLens(const Eigen::Vector3d& p) const {
    return fromPlane(std::visit([&](const auto& lens) { return lens.image(p); }, in_.lens));
}

Eigen::Vector3d CameraModel::throughLens(double u, double v, double z) const {
    const Eigen::Vector2d image = toPlane({u, v});
    const Eigen::Vector3d ray =
        std::visit([&](const auto& lens) { return lens.ray(image); }, in_.lens);
    if (!(ray.z() > 0)) return Eigen::Vector3d::Constant(std::nan(""));
    return {ray.x() / ray.z() * z, ray.y() / ray.z() * z, z};
}

Matrix23d CameraModel::lensJacobian(const Eigen::Vector3d& p, double weight) const {
    const Eigen::Vector2d scale(weight * in_.fx, weight * in_.fy);
    return scale.asDiagonal() *
           std::visit([&](const auto& lens) { return lens.jacobian(p); }, in_.lens);
}

Eigen::Vector3d CameraModel::bearing(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d image = toPlane(pixel);
    return std::visit([&](const auto& lens) { return lens.ray(image); }, in_.lens).normalized();
}

Eigen::Matrix<double, 3, 2> CameraModel::unprojectionJacobian(const Eigen::Vector2d& pixel,
                                                              double z) const {
    const Matrix23d J = projectionJacobian(unproject(pixel.x(), pixel.y(), z));
    Eigen::Matrix<double, 3, 2> by_pixel;
    by_pixel << J.leftCols<2>().inverse(), Eigen::RowVector2d::Zero();
    return by_pixel;
}

double CameraModel::pixelAngle(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d ray = bearing(pixel);
    const Eigen::Vector3d across = ray.unitOrthogonal();
    Eigen::Matrix<double, 3, 2> sphere;
    sphere << across, ray.cross(across);
    return 1 / std::sqrt(std::abs((projectionJacobian(ray) * sphere).determinant()));
}

double CameraModel::fieldOfView() const {
    return 2 * std::atan(0.5 * width / in_.fx);
}

bool CameraModel::isValid(const Eigen::Vector3d& p) const {
    if (!distorts_) return p.z() > 0;
    return std::visit(
        [&](const auto& lens) {
            const double eccentricity = lens.eccentricity(p);
            return std::isfinite(eccentricity) && lens.growsTo(eccentricity);
        },
        in_.lens);
}

bool CameraModel::isInvertible() const {
    constexpr int steps = 8;
    constexpr double most_off_px = 1;
    if (!distorts_) return true;
    Eigen::Vector3d farthest = Eigen::Vector3d::UnitZ();
    for (int row = 0; row <= steps; ++row) {
        for (int column = 0; column <= steps; ++column) {
            const Eigen::Vector2d seen((width - 1.0) * column / steps,
                                       (height - 1.0) * row / steps);
            const Eigen::Vector3d ray = bearing(seen);
            if (!((throughLens(ray) - seen).norm() <= most_off_px)) return false;
            if (ray.z() < farthest.z()) farthest = ray;
        }
    }
    return isValid(farthest);
}

CameraModel CameraModel::pinhole() const {
    Intrinsics without = intrinsics();
    without.lens = BrownLens();
    return without;
}

CameraModel CameraModel::rectified() const {
    return isFisheye() ? *this : pinhole();
}

Eigen::Vector2d CameraModel::rectify(const Eigen::Vector2d& seen) const {
    if (!distorts_ || isFisheye()) return seen;
    return fromPlane(throughLens(seen.x(), seen.y(), 1).head<2>());
}

Eigen::Vector2d CameraModel::unrectify(const Eigen::Vector2d& rectified) const {
    if (!distorts_ || isFisheye()) return rectified;
    const Eigen::Vector2d n = toPlane(rectified);
    return throughLens(Eigen::Vector3d(n.x(), n.y(), 1));
}

CameraModel CameraModel::shrunk(int block_px) const {
    Intrinsics small = intrinsics();
    small.width = width / block_px;
    small.height = height / block_px;
    small.fx = in_.fx / block_px;
    small.fy = in_.fy / block_px;
    small.cx = (in_.cx - 0.5 * (block_px - 1)) / block_px;
    small.cy = (in_.cy - 0.5 * (block_px - 1)) / block_px;
    return small;
}

CameraModel CameraModel::subsampled(int n) const {
    Intrinsics small = intrinsics();
    small.width = (width + n - 1) / n;
    small.height = (height + n - 1) / n;
    for (double* value : {&small.fx, &small.fy, &small.cx, &small.cy}) *value /= n;
    return small;
}

Eigen::Matrix3d CameraModel::inverseMatrix() const {
    Eigen::Matrix3d K_inverse;
    K_inverse << 1 / in_.fx, 0, -in_.cx / in_.fx, 0, 1 / in_.fy, -in_.cy / in_.fy, 0, 0, 1;
    return K_inverse;
}

Intrinsics scaled(const Intrinsics& camera, double factor, int width, int height) {
    Intrinsics result = camera;
    result.width = width;
    result.height = height;
    result.fx = camera.fx * factor;
    result.fy = camera.fy * factor;
    result.cx = (camera.cx + 0.5) * factor - 0.5;
    result.cy = (camera.cy + 0.5) * factor - 0.5;
    return result;
}

}  // namespace rgbd_graphslam
