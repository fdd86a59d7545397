/** Distance to the nearest of many points. */
#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

namespace rgbd_graphslam {

/** A kd-tree. */
class PointTree {
  public:
    /** \param points one or more; must outlive the tree */
    explicit PointTree(const std::vector<Eigen::Vector3d>& points);
    ~PointTree();

    /** In meters. */
    double distanceTo(const Eigen::Vector3d& p) const;

  private:
    class Implementation;
    std::unique_ptr<Implementation> impl_;
};

}  // namespace rgbd_graphslam
