/** Nearest neighbors in the plane. */
#pragma once
#include <vector>

#include "rgbd_graphslam/laser/planar_scan.h"

namespace rgbd_graphslam {

/** Points with normals, sorted into square cells. */
class PointIndex {
  public:
    /** Thins the points to one per square of `spacing_m` and direction of the normal; points
     *  without a normal are left out. */
    explicit PointIndex(const std::vector<ScanPoint>& points, double spacing_m = 0.03);

    /** The nearest point within `gate_m` (at most `cell_m`) whose surface faces the same way as
     *  `normal`, or any way where that is zero; null where there is none. */
    const ScanPoint* nearest(const Eigen::Vector2d& p, const Eigen::Vector2d& normal,
                             double gate_m) const;

    std::size_t size() const { return points_.size(); }

    static constexpr double cell_m = 0.5;

  private:
    int columnOf(double x) const { return static_cast<int>(std::floor((x - low_.x()) / cell_m)); }
    int rowOf(double y) const { return static_cast<int>(std::floor((y - low_.y()) / cell_m)); }

    Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
    int columns_ = 0, rows_ = 0;
    std::vector<ScanPoint> points_;   // by cell
    std::vector<std::size_t> begin_;  // of each cell, and the end of the last
};

}  // namespace rgbd_graphslam
