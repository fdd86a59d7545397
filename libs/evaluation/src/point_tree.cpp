#include "point_tree.h"

#include <cmath>
#include <cstdint>
#include <nanoflann.hpp>

namespace rgbd_graphslam {
namespace {

/** The view of the points that nanoflann asks for. */
struct PointSet {
    const std::vector<Eigen::Vector3d>& points;

    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t index, std::size_t axis) const { return points[index][axis]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using Index = std::uint32_t;
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointSet>,
                                                 PointSet, 3, Index>;

}  // namespace

class PointTree::Implementation {
  public:
    explicit Implementation(const std::vector<Eigen::Vector3d>& points)
        : set_{points}, tree_(3, set_) {}

    double squaredDistanceTo(const Eigen::Vector3d& p) const {
        Index nearest = 0;
        double squared = 0;
        tree_.knnSearch(p.data(), 1, &nearest, &squared);
        return squared;
    }

  private:
    PointSet set_;
    Tree tree_;
};

PointTree::PointTree(const std::vector<Eigen::Vector3d>& points)
    : impl_(std::make_unique<Implementation>(points)) {}

PointTree::~PointTree() = default;

double PointTree::distanceTo(const Eigen::Vector3d& p) const {
    return std::sqrt(impl_->squaredDistanceTo(p));
}

}  // namespace rgbd_graphslam
