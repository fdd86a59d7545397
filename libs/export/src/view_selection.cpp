#include "rgbd_graphslam/export/view_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rgbd_graphslam {
namespace {

constexpr float nearest_m = 0.05f;
constexpr float border_px = 1;
constexpr float least_cosine = 0.15f;

using Triangle = std::array<std::uint32_t, 3>;

Eigen::Vector3f normalOf(const PlyModel& mesh, const Triangle& t) {
    const Eigen::Vector3f& a = mesh.vertices[t[0]];
    return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
}

/** Twice the signed area in the image; negative where the front faces the camera, as v points
 *  down. */
float signedArea2(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/** Writes the depths of one triangle where they are the nearest; 1 / z is linear in the image. */
void rasterize(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c,
               cv::Mat1f& nearest) {
    if (std::min({a.z(), b.z(), c.z()}) < nearest_m) return;
    const float area = signedArea2(a, b, c);
    if (area == 0) return;
    const auto low = [](float x, float y, float z) { return std::ceil(std::min({x, y, z})); };
    const auto high = [](float x, float y, float z) { return std::floor(std::max({x, y, z})); };
    const int u0 = static_cast<int>(std::max(0.f, low(a.x(), b.x(), c.x())));
    const int v0 = static_cast<int>(std::max(0.f, low(a.y(), b.y(), c.y())));
    const int u1 =
        static_cast<int>(std::min(static_cast<float>(nearest.cols - 1), high(a.x(), b.x(), c.x())));
    const int v1 =
        static_cast<int>(std::min(static_cast<float>(nearest.rows - 1), high(a.y(), b.y(), c.y())));
    for (int v = v0; v <= v1; ++v) {
        for (int u = u0; u <= u1; ++u) {
            const Eigen::Vector3f p(static_cast<float>(u), static_cast<float>(v), 0);
            const float wa = signedArea2(p, b, c) / area, wb = signedArea2(a, p, c) / area;
            const float wc = 1 - wa - wb;
            if (std::min({wa, wb, wc}) < 0) continue;
            const float z = 1 / (wa / a.z() + wb / b.z() + wc / c.z());
            nearest(v, u) = std::min(nearest(v, u), z);
        }
    }
}

/** Mean length of edges, of a sample of the triangles. */
float meanEdge(const PlyModel& mesh) {
    double sum = 0;
    const std::size_t step = 1 + mesh.triangles.size() / 10000;
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += step, ++count) {
        const Triangle& t = mesh.triangles[i];
        sum += (mesh.vertices[t[0]] - mesh.vertices[t[1]]).norm();
    }
    return count ? static_cast<float>(sum / static_cast<double>(count)) : 0;
}

cv::Point pixelOf(const Eigen::Vector3f& vertex) {
    return {static_cast<int>(std::lround(vertex.x())), static_cast<int>(std::lround(vertex.y()))};
}

}  // namespace

TriangleNeighbors neighborsOf(const std::vector<Triangle>& triangles) {
    struct Side {
        std::uint64_t edge;
        std::uint32_t triangle, side;
    };
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        for (std::uint32_t side = 0; side < 3; ++side) {
            const std::uint64_t a = triangles[i][side], b = triangles[i][(side + 1) % 3];
            sides.push_back({std::min(a, b) << 32 | std::max(a, b), i, side});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
    });
    TriangleNeighbors neighbors(triangles.size(), {-1, -1, -1});
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
        if (end - i == 2) {
            const Side &a = sides[i], &b = sides[i + 1];
            neighbors[a.triangle][a.side] = static_cast<std::int32_t>(b.triangle);
            neighbors[b.triangle][b.side] = static_cast<std::int32_t>(a.triangle);
        }
        i = end;
    }
    return neighbors;
}

ProjectedMesh::ProjectedMesh(const PlyModel& mesh, const Camera& camera, const SE3& T_world_cam)
    : nearest(camera.height, camera.width, std::numeric_limits<float>::infinity()) {
    const SE3 T_cam_world = T_world_cam.inverse();
    vertices.reserve(mesh.vertices.size());
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
        const Eigen::Vector3d p = T_cam_world * vertex.cast<double>();
        const Eigen::Vector2d pixel =
            p.z() > 0 ? camera.project(p) : Eigen::Vector2d(Eigen::Vector2d::Zero());
        vertices.push_back(Eigen::Vector3d(pixel.x(), pixel.y(), p.z()).cast<float>());
    }
    for (const Triangle& t : mesh.triangles)
        rasterize(vertices[t[0]], vertices[t[1]], vertices[t[2]], nearest);
}

ViewSelection::ViewSelection(const PlyModel& mesh)
    : mesh_(mesh), tolerance_m_(meanEdge(mesh)), best_(mesh.triangles.size()) {}

float ViewSelection::score(std::size_t triangle, const ProjectedMesh& seen, const Camera& camera,
                           const cv::Mat1w& depth, double depth_unit_m) const {
    constexpr float least_tolerance_m = 0.05f, tolerance_share = 0.03f, without_reading = 0.5f,
                    turned_away = 0.01f;
    const Triangle& t = mesh_.triangles[triangle];
    const Eigen::Vector3f &a = seen.vertices[t[0]], &b = seen.vertices[t[1]],
                          &c = seen.vertices[t[2]];
    const Eigen::Vector3f middle = (a + b + c) / 3;
    for (const Eigen::Vector3f* p : {&a, &b, &c, &middle}) {
        if (p->z() < nearest_m) return 0;
        if (!(p->x() >= border_px && p->x() <= static_cast<float>(camera.width - 1) - border_px))
            return 0;
        if (!(p->y() >= border_px && p->y() <= static_cast<float>(camera.height - 1) - border_px))
            return 0;
        const float slack_m = std::max(tolerance_m_, tolerance_share * p->z());
        if (p->z() > seen.nearest(pixelOf(*p)) + slack_m) return 0;
    }
    const float area_px = -0.5f * signedArea2(a, b, c);
    // Area in the image over the area that the triangle would have face on.
    const float pixels_per_m2 =
        static_cast<float>(camera.pixelsPerSteradian()) / (middle.z() * middle.z());
    const float cosine = area_px / (0.5f * normalOf(mesh_, t).norm() * pixels_per_m2);
    const float reading_m = static_cast<float>(depth(pixelOf(middle)) * depth_unit_m);
    const float agreement_m = std::max(least_tolerance_m, tolerance_share * middle.z());
    if (reading_m > 0 && std::abs(reading_m - middle.z()) > agreement_m) return 0;
    const float trust = reading_m > 0 ? 1 : without_reading;
    if (cosine < least_cosine) return trust * turned_away * std::abs(area_px);
    return trust * area_px * std::min(cosine, 1.f);
}

void ViewSelection::keep(std::size_t triangle, Candidate candidate) {
    for (Candidate& other : best_[triangle]) {
        if (candidate.score > other.score) std::swap(candidate, other);
    }
}

void ViewSelection::add(int view, const Camera& camera, const SE3& T_world_cam,
                        const cv::Mat1w& depth, double depth_unit_m) {
    const ProjectedMesh seen(mesh_, camera, T_world_cam);
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
        const float value = score(i, seen, camera, depth, depth_unit_m);
        if (value > 0) keep(i, {view, value});
    }
}

int ViewSelection::cheapest(std::size_t triangle, const std::array<std::int32_t, 3>& neighbors,
                            const std::vector<int>& views) const {
    constexpr float cost_of_seam = 0.4f;
    const float best = best_[triangle][0].score;
    float least = std::numeric_limits<float>::infinity();
    int view = no_view;
    for (const Candidate& candidate : best_[triangle]) {
        if (candidate.view == no_view) break;
        float cost = 1 - candidate.score / best;
        for (const std::int32_t neighbor : neighbors) {
            if (neighbor >= 0 && views[neighbor] != candidate.view) cost += cost_of_seam;
        }
        if (cost >= least) continue;
        least = cost;
        view = candidate.view;
    }
    return view;
}

std::vector<int> ViewSelection::views(const TriangleNeighbors& neighbors) const {
    constexpr int sweeps = 10;
    std::vector<int> views;
    views.reserve(best_.size());
    for (const auto& candidates_of : best_) views.push_back(candidates_of[0].view);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (std::size_t i = 0; i < views.size(); ++i) views[i] = cheapest(i, neighbors[i], views);
    }
    return views;
}

}  // namespace rgbd_graphslam
