#include "rgbd_graphslam/viewer/measuring.h"

#include <cmath>

#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {

std::string Measuring::toggle() {
    active_ = !active_;
    points_.clear();
    return active_ ? "click two points" : " ";
}

std::string Measuring::add(const std::optional<Eigen::Vector3d>& point) {
    if (!point) return "nothing there to measure";
    if (points_.size() == 2) points_.clear();
    points_.push_back(*point);
    if (points_.size() == 1) {
        return formatted("from (%.3f, %.3f, %.3f) m; click the other point", point->x(), point->y(),
                         point->z());
    }
    const Eigen::Vector3d d = points_[1] - points_[0];
    return formatted("distance %.3f m: %.3f m on the level, %.3f m in height", d.norm(),
                     d.head<2>().norm(), std::abs(d.z()));
}

}  // namespace rgbd_graphslam
