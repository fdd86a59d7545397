/** Distance to a surface of triangles. */
#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "rgbd_graphslam/geometry/ply.h"

namespace rgbd_graphslam {

/** Hierarchy of bounding boxes over the triangles of a mesh. */
class TriangleTree {
  public:
    /** \param mesh with a triangle or more; must outlive the tree */
    explicit TriangleTree(const PlyModel& mesh);

    /** Exact distance in meters of a point to the nearest triangle. */
    double distanceTo(const Eigen::Vector3d& p) const;

  private:
    /** A leaf holds the triangles of [first, last), an inner node two children. */
    struct Node {
        Eigen::AlignedBox3d box;
        std::size_t first = 0, last = 0;
        int children[2] = {-1, -1};

        bool isLeaf() const { return children[0] < 0; }
    };

    int build(std::size_t first, std::size_t last);
    void descend(int index, const Eigen::Vector3d& p, double& best_squared) const;
    Eigen::Vector3d corner(std::size_t triangle, int which) const;
    Eigen::AlignedBox3d boxOf(std::size_t triangle) const;
    double squaredDistance(std::size_t triangle, const Eigen::Vector3d& p) const;

    const PlyModel& mesh_;
    std::vector<std::uint32_t> order_;  // of the triangles, so that each node's are together
    std::vector<Node> nodes_;
};

}  // namespace rgbd_graphslam
