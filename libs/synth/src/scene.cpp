#include "rgbd_graphslam/synth/scene.h"

#include <cmath>

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;

/** Repeating materials keep their scale; where the repetition starts depends on the place alone, so
 *  that equal boxes do not look equal. */
std::array<Vector2d, 4> uvOf(const Material& material, const Skin& skin, double width,
                             double height, const Vector3d& place) {
    Vector2d from = skin.uv_min, to = skin.uv_max;
    if (material.tile_m > 0) {
        from = Vector2d(place.x() * 0.37 + place.z() * 0.71, place.y() * 0.53 + place.z() * 0.29);
        from = from.array() - from.array().floor();
        to = from + Vector2d(width, height) / material.tile_m;
    }
    return {Vector2d(from.x(), to.y()), to, Vector2d(to.x(), from.y()), from};
}
}  // namespace

int Scene::addMaterial(const cv::Mat& image, double tile_m, double glow) {
    materials.push_back({image, tile_m, glow});
    return static_cast<int>(materials.size()) - 1;
}

void label(std::vector<Quad>& quads, Label label, std::size_t first) {
    for (std::size_t i = first; i < quads.size(); ++i)
        if (quads[i].label == Label::None) quads[i].label = label;
}

void addRectangle(const Scene& scene, std::vector<Quad>& quads, const SE3& frame, double width,
                  double height, const Skin& skin) {
    Quad quad;
    quad.corners = {frame * Vector3d(0, 0, 0), frame * Vector3d(0, width, 0),
                    frame * Vector3d(0, width, height), frame * Vector3d(0, 0, height)};
    quad.uv = uvOf(scene.materials[skin.material], skin, width, height, frame.t);
    quad.material = skin.material;
    quads.push_back(quad);
}

void addBox(const Scene& scene, std::vector<Quad>& quads, const SE3& frame, const Vector3d& size,
            const BoxSkin& skin) {
    const auto face = [&](const Vector3d& origin, const Vector3d& right, const Vector3d& up,
                          double width, double height, const Skin& face_skin) {
        if (face_skin.material == kHidden.material) return;
        Eigen::Matrix3d axes;
        axes << right.cross(up), right, up;
        addRectangle(scene, quads, frame * SE3(axes, origin), width, height, face_skin);
    };
    const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const double hx = size.x() / 2, hy = size.y() / 2, h = size.z();
    face({hx, -hy, 0}, y, z, size.y(), h, skin.front);
    face({-hx, hy, 0}, -y, z, size.y(), h, skin.back);
    face({hx, hy, 0}, -x, z, size.x(), h, skin.sides);
    face({-hx, -hy, 0}, x, z, size.x(), h, skin.sides);
    face({hx, -hy, h}, y, -x, size.y(), size.x(), skin.top);
    face({-hx, -hy, 0}, y, x, size.y(), size.x(), skin.bottom);
}

void addCylinder(std::vector<Quad>& quads, const SE3& frame, double radius, double top_radius,
                 double height, const Skin& side, const Skin& cap, int sides) {
    const auto rim = [&](int i, double r, double z) {
        const double angle = 2 * std::acos(-1.0) * i / sides;
        return Vector3d(r * std::cos(angle), r * std::sin(angle), z);
    };
    const Vector2d span = side.uv_max - side.uv_min;
    for (int i = 0; i < sides; ++i) {
        const double u0 = side.uv_min.x() + span.x() * i / sides;
        const double u1 = side.uv_min.x() + span.x() * (i + 1) / sides;
        const double v0 = side.uv_min.y(), v1 = side.uv_max.y();
        quads.push_back(
            {{frame * rim(i, radius, 0), frame * rim(i + 1, radius, 0),
              frame * rim(i + 1, top_radius, height), frame * rim(i, top_radius, height)},
             {Vector2d(u0, v1), Vector2d(u1, v1), Vector2d(u1, v0), Vector2d(u0, v0)},
             side.material});
    }
    const auto capUv = [&](const Vector3d& p, double r) -> Vector2d {
        const Vector2d share(0.5 + p.x() / (2 * r), 0.5 - p.y() / (2 * r));
        return cap.uv_min + share.cwiseProduct(cap.uv_max - cap.uv_min);
    };
    for (int i = 0; i + 1 < sides; i += 2) {
        const Vector3d center(0, 0, height);
        const Vector3d a = rim(i, top_radius, height), b = rim(i + 1, top_radius, height),
                       c = rim(i + 2, top_radius, height);
        quads.push_back({{frame * center, frame * a, frame * b, frame * c},
                         {capUv(center, top_radius), capUv(a, top_radius), capUv(b, top_radius),
                          capUv(c, top_radius)},
                         cap.material});
    }
}

SE3 standing(double x, double y, double z, double yaw_rad) {
    return {rotationExp({0, 0, yaw_rad}), {x, y, z}};
}

}  // namespace rgbd_graphslam::synth
