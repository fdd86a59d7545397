#include "rgbd_graphslam/mapping/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace rgbd_graphslam {
namespace {

constexpr double turn_rad_per_px = 0.006;
constexpr double steepest_rad = M_PI / 2;
constexpr double nearest_distance_m = 0.05, farthest_distance_m = 5000;

}  // namespace

Eigen::Vector3d OrbitCamera::backward() const {
    return {std::cos(elevation_rad) * std::cos(azimuth_rad),
            std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

Eigen::Vector3d OrbitCamera::right() const {
    return {-std::sin(azimuth_rad), std::cos(azimuth_rad), 0};
}

void OrbitCamera::orbit(const Eigen::Vector2d& motion_px) {
    azimuth_rad = std::remainder(azimuth_rad - turn_rad_per_px * motion_px.x(), 2 * M_PI);
    elevation_rad =
        std::clamp(elevation_rad + turn_rad_per_px * motion_px.y(), -steepest_rad, steepest_rad);
}

void OrbitCamera::pan(const Eigen::Vector2d& motion_px, int height_px) {
    const double m_per_px = distance_m / focalPx(height_px);
    target += m_per_px * (motion_px.y() * up() - motion_px.x() * right());
}

void OrbitCamera::zoom(double factor, const Eigen::Vector2d& pixel,
                       const Eigen::Vector2i& size_px) {
    const double before_m = distance_m;
    distance_m = std::clamp(factor * distance_m, nearest_distance_m, farthest_distance_m);
    const Eigen::Vector2d from_center = pixel - 0.5 * size_px.cast<double>();
    const double m_per_px = (before_m - distance_m) / focalPx(size_px.y());
    target += m_per_px * (from_center.x() * right() - from_center.y() * up());
}

void OrbitCamera::lookDown() {
    azimuth_rad = -M_PI / 2;
    elevation_rad = M_PI / 2;
}

void OrbitCamera::frame(const Eigen::AlignedBox3d& box, const Eigen::Vector2i& size_px,
                        const Eigen::Vector2d& share) {
    target = box.center();
    const double tangent = std::tan(field_of_view_rad / 2);
    const double tangent_x = share.x() * tangent * size_px.x() / size_px.y();
    const double tangent_y = share.y() * tangent;
    const Eigen::Vector3d x = right(), y = up(), z = backward();
    double needed_m = nearest_distance_m;
    for (int i = 0; i < 8; ++i) {
        const auto kind = static_cast<Eigen::AlignedBox3d::CornerType>(i);
        const Eigen::Vector3d p = box.corner(kind) - target;
        const double sideways =
            std::max(std::abs(p.dot(x)) / tangent_x, std::abs(p.dot(y)) / tangent_y);
        needed_m = std::max(needed_m, sideways + p.dot(z));
    }
    distance_m = std::min(1.05 * needed_m, farthest_distance_m);
}

void OrbitCamera::frame(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector2i& size_px,
                        const Eigen::Vector2d& share) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : points) box.extend(p);
    if (box.isEmpty()) return;
    frame(box, size_px, share);
    constexpr double margin = 1.14;
    const Eigen::Array2d room_px = share.array() * size_px.cast<double>().array();
    for (int i = 0; i < 6; ++i) {  // perspective changes with the distance
        Eigen::AlignedBox2d seen;
        for (const Eigen::Vector3d& p : points) {
            const Eigen::Vector3d uvz = project(p, size_px);
            if (uvz.z() > 0) seen.extend(uvz.head<2>());
        }
        if (seen.isEmpty()) return;
        pan(0.5 * size_px.cast<double>() - seen.center(), size_px.y());
        const double growth = margin * (seen.sizes().array() / room_px).maxCoeff();
        distance_m = std::clamp(std::clamp(growth, 0.3, 3.) * distance_m, nearest_distance_m,
                                farthest_distance_m);
    }
}

double OrbitCamera::focalPx(int height_px) {
    return 0.5 * height_px / std::tan(field_of_view_rad / 2);
}

Eigen::Matrix4d OrbitCamera::eyeFromWorld() const {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.block<1, 3>(0, 0) = right().transpose();
    matrix.block<1, 3>(1, 0) = up().transpose();
    matrix.block<1, 3>(2, 0) = backward().transpose();
    matrix.block<3, 1>(0, 3) = -matrix.block<3, 3>(0, 0) * eye();
    return matrix;
}

Eigen::Matrix4d OrbitCamera::clipFromWorld(const Eigen::Vector2i& size_px) const {
    const double cotangent = 1 / std::tan(field_of_view_rad / 2);
    const double n = nearest_m(), f = farthest_m();
    Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
    projection(0, 0) = cotangent * size_px.y() / size_px.x();
    projection(1, 1) = cotangent;
    projection(2, 2) = (f + n) / (n - f);
    projection(2, 3) = 2 * f * n / (n - f);
    projection(3, 2) = -1;
    return projection * eyeFromWorld();
}

Eigen::Vector3d OrbitCamera::project(const Eigen::Vector3d& p,
                                     const Eigen::Vector2i& size_px) const {
    const Eigen::Vector4d clip = clipFromWorld(size_px) * p.homogeneous();
    const Eigen::Vector2d half = 0.5 * size_px.cast<double>();
    return {half.x() * (1 + clip.x() / clip.w()), half.y() * (1 - clip.y() / clip.w()), clip.w()};
}

Eigen::Vector3d OrbitCamera::unproject(const Eigen::Vector2d& pixel, double depth,
                                       const Eigen::Vector2i& size_px) const {
    const Eigen::Vector4d clip(2 * pixel.x() / size_px.x() - 1, 1 - 2 * pixel.y() / size_px.y(),
                               2 * depth - 1, 1);
    return (clipFromWorld(size_px).inverse() * clip).hnormalized();
}

}  // namespace rgbd_graphslam
