#include "rgbd_graphslam/synth/lighting.h"

#include <cmath>

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;

constexpr double kCell = 0.05;         // m
constexpr double kAmbientReach = 1.2;  // m
constexpr double kNear = 0.09;         // m, rays begin outside the surface's own cells
constexpr int kDirections = 64;

/** Points spread evenly over the unit sphere (Fibonacci lattice). */
std::vector<Vector3d> sphere(int count) {
    const double golden = std::acos(-1.0) * (3 - std::sqrt(5.0));
    std::vector<Vector3d> points;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * i + 1) / count, r = std::sqrt(1 - z * z);
        points.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), z);
    }
    return points;
}
}  // namespace

Lighting::Lighting(const Scene& scene) : scene_(scene), directions_(sphere(kDirections)) {
    Vector3d low = Vector3d::Constant(1e9), high = -low;
    for (const Quad& quad : scene.quads)
        for (const Vector3d& corner : quad.corners) {
            low = low.cwiseMin(corner);
            high = high.cwiseMax(corner);
        }
    origin_ = low - Vector3d::Constant(kCell);
    size_ = ((high - origin_) / kCell).array().ceil().cast<int>() + 2;
    cells_.assign(static_cast<std::size_t>(size_.x()) * size_.y() * size_.z(), 0);
    for (const Quad& quad : scene.quads)
        if (scene.materials[quad.material].glow < 1) occupy(quad);
}

void Lighting::occupy(const Quad& quad) {
    const auto steps = [](const Vector3d& edge) {
        return std::max(1, static_cast<int>(std::ceil(2 * edge.norm() / kCell)));
    };
    const int nu = steps(quad.corners[1] - quad.corners[0]);
    const int nv = steps(quad.corners[3] - quad.corners[0]);
    const Vector3d inwards = -0.01 * quad.normal();
    for (int iv = 0; iv <= nv; ++iv)
        for (int iu = 0; iu <= nu; ++iu) {
            const double u = static_cast<double>(iu) / nu, v = static_cast<double>(iv) / nv;
            const Vector3d point = (1 - v) * ((1 - u) * quad.corners[0] + u * quad.corners[1]) +
                                   v * ((1 - u) * quad.corners[3] + u * quad.corners[2]) + inwards;
            const Eigen::Vector3i cell = ((point - origin_) / kCell).cast<int>();
            if ((cell.array() < 0).any() || (cell.array() >= size_.array()).any()) continue;
            cells_[(static_cast<std::size_t>(cell.z()) * size_.y() + cell.y()) * size_.x() +
                   cell.x()] = 1;
        }
}

bool Lighting::occupied(const Vector3d& point) const {
    const Eigen::Vector3i cell = ((point - origin_) / kCell).cast<int>();
    if ((cell.array() < 0).any() || (cell.array() >= size_.array()).any()) return false;
    return cells_[(static_cast<std::size_t>(cell.z()) * size_.y() + cell.y()) * size_.x() +
                  cell.x()] != 0;
}

double Lighting::freeLength(const Vector3d& from, const Vector3d& direction, double reach) const {
    for (double length = 0; length < reach; length += kCell)
        if (occupied(from + length * direction)) return length;
    return reach;
}

double Lighting::openness(const Vector3d& point, const Vector3d& normal) const {
    double open = 0, total = 0;
    for (const Vector3d& direction : directions_) {
        const double weight = direction.dot(normal);
        if (weight <= 0.05) continue;
        total += weight;
        open += weight * freeLength(point, direction, kAmbientReach) / kAmbientReach;
    }
    return open / total;
}

Vector3d Lighting::at(const Vector3d& point, const Vector3d& normal) const {
    const Vector3d outside = point + kNear * normal;
    Vector3d light = Vector3d::Constant(scene_.ambient * (0.25 + 0.75 * openness(outside, normal)));
    for (const Lamp& lamp : scene_.lamps) {
        const Vector3d way = lamp.position - outside;
        const double distance = way.norm();
        const double facing = normal.dot(way) / distance;
        if (facing <= 0 || distance > 9) continue;
        const double free = freeLength(outside, way / distance, distance - 0.15);
        if (free < distance - 0.15 - 1e-9) continue;
        light += lamp.tint * (lamp.intensity * facing / (0.4 + 0.25 * distance * distance));
    }
    return light.cwiseMin(1.25);
}

}  // namespace rgbd_graphslam::synth
