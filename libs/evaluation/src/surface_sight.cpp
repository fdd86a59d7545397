#include "rgbd_graphslam/evaluation/surface_sight.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr double near_m = 0.05;

struct Pixels {
    int u0, v0, u1, v1;
};

/** Pixels that a triangle may cover; all when it reaches behind the camera. */
Pixels boundsOf(const std::array<Eigen::Vector3d, 3>& corners, const Camera& camera) {
    Pixels all{0, 0, camera.width - 1, camera.height - 1};
    Eigen::Array2d low(1e9, 1e9), high(-1e9, -1e9);
    for (const auto& corner : corners) {
        if (corner.z() < near_m) return all;
        const Eigen::Array2d pixel = camera.project(corner).array();
        low = low.min(pixel);
        high = high.max(pixel);
    }
    const auto whole = [](double x) { return static_cast<int>(std::clamp(x, -1e6, 1e6)); };
    return {std::max(all.u0, whole(std::ceil(low.x()))),
            std::max(all.v0, whole(std::ceil(low.y()))),
            std::min(all.u1, whole(std::floor(high.x()))),
            std::min(all.v1, whole(std::floor(high.y())))};
}

}  // namespace

SurfaceSight::SurfaceSight(const PlyModel& surface, const Camera& camera, const Trajectory& cameras,
                           const SightOptions& options)
    : surface_(surface),
      camera_(camera.pinhole().shrunk(2)),
      options_(options),
      least_cosine_(std::cos(options.max_incidence_deg * M_PI / 180)) {
    if (surface.triangles.empty()) {
        throw Error("a surface of points hides nothing", "give triangles to tell what was seen");
    }
    if (cameras.empty()) throw Error("no camera saw the surface", "give its trajectory");
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        const Eigen::Vector3d a = corner(i, 0);
        const Eigen::Vector3d normal = (corner(i, 1) - a).cross(corner(i, 2) - a).normalized();
        planes_.emplace_back(normal.x(), normal.y(), normal.z(), normal.dot(a));
    }
    const std::size_t step = (cameras.size() + options.max_views - 1) / options.max_views;
    for (std::size_t i = 0; i < cameras.size(); i += step) {
        views_.push_back(render(cameras[i].T_world_cam.inverse()));
    }
}

Eigen::Vector3d SurfaceSight::corner(std::size_t triangle, int which) const {
    return surface_.vertices[surface_.triangles[triangle][which]].cast<double>();
}

SurfaceSight::View SurfaceSight::render(const SE3& T_cam_world) const {
    const auto pixels = static_cast<std::size_t>(camera_.width) * camera_.height;
    View view{T_cam_world, std::vector<std::int32_t>(pixels, -1)};
    std::vector<float> inverse_depth(pixels, 0);
    for (std::size_t i = 0; i < surface_.triangles.size(); ++i) draw(i, view, inverse_depth);
    return view;
}

/** In homogeneous coordinates, which need no clipping: Olano and Greer, "Triangle scan conversion
 *  using 2D homogeneous coordinates", Graphics Hardware 1997. */
void SurfaceSight::draw(std::size_t triangle, View& view, std::vector<float>& inverse_depth) const {
    std::array<Eigen::Vector3d, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = view.T_cam_world * corner(triangle, k);
    if (std::max({p[0].z(), p[1].z(), p[2].z()}) < near_m) return;
    const double volume = p[0].dot(p[1].cross(p[2]));
    if (std::abs(volume) < 1e-12) return;  // seen from the side
    const Eigen::Matrix3d edges =
        (Eigen::Matrix3d() << p[1].cross(p[2]), p[2].cross(p[0]), p[0].cross(p[1])).finished() /
        volume;
    const Pixels bounds = boundsOf(p, camera_);
    for (int v = bounds.v0; v <= bounds.v1; ++v) {
        for (int u = bounds.u0; u <= bounds.u1; ++u) {
            const Eigen::Vector3d share = edges.transpose() * camera_.unproject(u, v, 1);
            const auto depth = static_cast<float>(share.sum());  // its inverse
            const std::size_t pixel = static_cast<std::size_t>(v) * camera_.width + u;
            if (share.minCoeff() < 0 || depth <= inverse_depth[pixel] || depth > 1 / near_m) {
                continue;
            }
            inverse_depth[pixel] = depth;
            view.triangle[pixel] = static_cast<std::int32_t>(triangle);
        }
    }
}

bool SurfaceSight::sees(const Eigen::Vector3d& p) const {
    return std::any_of(views_.begin(), views_.end(),
                       [&](const View& view) { return shows(view, p); });
}

bool SurfaceSight::liesOn(std::int32_t triangle, const Eigen::Vector3d& p) const {
    constexpr double tolerance_m = 0.002;
    const Eigen::Vector4d& plane = planes_[triangle];
    return std::abs(plane.head<3>().dot(p) - plane.w()) < tolerance_m;
}

/** \param ray from the camera to the triangle, world axes */
bool SurfaceSight::isSteep(std::int32_t triangle, const Eigen::Vector3d& ray) const {
    return std::abs(planes_[triangle].head<3>().dot(ray)) >= least_cosine_ * ray.norm();
}

bool SurfaceSight::shows(const View& view, const Eigen::Vector3d& p) const {
    const Eigen::Vector3d in_camera = view.T_cam_world * p;
    if (in_camera.z() < options_.min_range_m || in_camera.z() > options_.max_range_m) return false;
    const Eigen::Vector2d pixel = camera_.project(in_camera);
    const Eigen::Vector3d ray = view.T_cam_world.R.transpose() * in_camera;
    const int u0 = static_cast<int>(std::floor(pixel.x())),
              v0 = static_cast<int>(std::floor(pixel.y()));
    for (const auto& [u, v] : {std::pair(u0, v0), {u0 + 1, v0}, {u0, v0 + 1}, {u0 + 1, v0 + 1}}) {
        if (u < 0 || v < 0 || u >= camera_.width || v >= camera_.height) continue;
        const std::int32_t front = view.triangle[static_cast<std::size_t>(v) * camera_.width + u];
        if (front >= 0 && liesOn(front, p) && isSteep(front, ray)) return true;
    }
    return false;
}

}  // namespace rgbd_graphslam
