#include "triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rgbd_graphslam {
namespace {

constexpr std::size_t triangles_in_leaf = 8;

double squaredDistanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b) {
    const Eigen::Vector3d ab = b - a;
    const double length_squared = ab.squaredNorm();
    const double along = length_squared > 0 ? (p - a).dot(ab) / length_squared : 0;
    return (p - a - std::clamp(along, 0.0, 1.0) * ab).squaredNorm();
}

/** Whether the foot of the perpendicular from p lies within the triangle. */
bool isAbove(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
             const Eigen::Vector3d& c, const Eigen::Vector3d& normal) {
    return (b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
           (a - c).cross(p - c).dot(normal) >= 0;
}

}  // namespace

TriangleTree::TriangleTree(const PlyModel& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, order_.size());
}

Eigen::Vector3d TriangleTree::corner(std::size_t triangle, int which) const {
    return mesh_.vertices[mesh_.triangles[triangle][which]].cast<double>();
}

Eigen::AlignedBox3d TriangleTree::boxOf(std::size_t triangle) const {
    Eigen::AlignedBox3d box;
    for (int which = 0; which < 3; ++which) box.extend(corner(triangle, which));
    return box;
}

int TriangleTree::build(std::size_t first, std::size_t last) {
    const int index = static_cast<int>(nodes_.size());
    nodes_.emplace_back();
    Eigen::AlignedBox3d box;
    for (std::size_t k = first; k < last; ++k) box.extend(boxOf(order_[k]));
    nodes_[index].box = box;
    nodes_[index].first = first;
    nodes_[index].last = last;
    if (last - first <= triangles_in_leaf) return index;

    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t middle = (first + last) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                         return boxOf(a).center()[axis] < boxOf(b).center()[axis];
                     });
    const int lower = build(first, middle), upper = build(middle, last);
    nodes_[index].children[0] = lower;
    nodes_[index].children[1] = upper;
    return index;
}

double TriangleTree::distanceTo(const Eigen::Vector3d& p) const {
    double best_squared = std::numeric_limits<double>::infinity();
    descend(0, p, best_squared);
    return std::sqrt(best_squared);
}

void TriangleTree::descend(int index, const Eigen::Vector3d& p, double& best_squared) const {
    const Node& node = nodes_[index];
    if (node.isLeaf()) {
        for (std::size_t k = node.first; k < node.last; ++k) {
            best_squared = std::min(best_squared, squaredDistance(order_[k], p));
        }
        return;
    }
    int nearer = node.children[0], farther = node.children[1];
    double nearer_squared = nodes_[nearer].box.squaredExteriorDistance(p);
    double farther_squared = nodes_[farther].box.squaredExteriorDistance(p);
    if (farther_squared < nearer_squared) {
        std::swap(nearer, farther);
        std::swap(nearer_squared, farther_squared);
    }
    if (nearer_squared < best_squared) descend(nearer, p, best_squared);
    if (farther_squared < best_squared) descend(farther, p, best_squared);
}

double TriangleTree::squaredDistance(std::size_t triangle, const Eigen::Vector3d& p) const {
    const Eigen::Vector3d a = corner(triangle, 0), b = corner(triangle, 1), c = corner(triangle, 2);
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double normal_squared = normal.squaredNorm();
    if (normal_squared > 0 && isAbove(p, a, b, c, normal)) {
        const double height = (p - a).dot(normal);
        return height * height / normal_squared;
    }
    return std::min({squaredDistanceToSegment(p, a, b), squaredDistanceToSegment(p, b, c),
                     squaredDistanceToSegment(p, c, a)});
}

}  // namespace rgbd_graphslam
