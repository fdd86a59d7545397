#include "rgbd_graphslam/mapping/mesh_parts.h"

#include <Eigen/Geometry>
#include <numeric>

namespace rgbd_graphslam {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/** Twice the area along the normal. */
Eigen::Vector3f crossProduct(const PlyModel& mesh, const Triangle& triangle) {
    const Eigen::Vector3f& a = mesh.vertices[triangle[0]];
    return (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
}

/** Sets of vertices (Tarjan, "Efficiency of a good but not linear set union algorithm", 1975). */
class Parts {
  public:
    explicit Parts(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::uint32_t of(std::uint32_t vertex) {
        while (parent_[vertex] != vertex) {
            parent_[vertex] = parent_[parent_[vertex]];
            vertex = parent_[vertex];
        }
        return vertex;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace

PlyModel meshOf(const PlyModel& mesh, std::vector<Triangle> triangles) {
    std::vector<bool> needed(mesh.vertices.size());
    for (const Triangle& triangle : triangles)
        for (const std::uint32_t vertex : triangle) needed[vertex] = true;
    PlyModel part;
    std::vector<std::uint32_t> number(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (!needed[i]) continue;
        number[i] = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[i]);
        if (!mesh.colors.empty()) part.colors.push_back(mesh.colors[i]);
    }
    for (Triangle& triangle : triangles)
        for (std::uint32_t& vertex : triangle) vertex = number[vertex];
    part.triangles = std::move(triangles);
    return part;
}

PlyModel withoutSmallParts(const PlyModel& mesh, double min_area_m2) {
    Parts parts(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        parts.join(a, b);
        parts.join(b, c);
    }
    std::vector<double> area_m2(mesh.vertices.size());
    for (const Triangle& triangle : mesh.triangles)
        area_m2[parts.of(triangle[0])] += 0.5 * crossProduct(mesh, triangle).norm();
    std::vector<Triangle> large;
    for (const Triangle& triangle : mesh.triangles)
        if (area_m2[parts.of(triangle[0])] >= min_area_m2) large.push_back(triangle);
    return meshOf(mesh, std::move(large));
}

void addNormals(PlyModel& mesh) {
    mesh.normals.assign(mesh.vertices.size(), Eigen::Vector3f::Zero());
    for (const Triangle& triangle : mesh.triangles) {
        const Eigen::Vector3f normal = crossProduct(mesh, triangle);
        for (const std::uint32_t vertex : triangle) mesh.normals[vertex] += normal;
    }
    for (Eigen::Vector3f& normal : mesh.normals) normal.normalize();
}

}  // namespace rgbd_graphslam
