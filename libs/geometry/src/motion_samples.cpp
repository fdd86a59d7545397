#include "rgbd_graphslam/geometry/motion_samples.h"

#include <cmath>

namespace rgbd_graphslam {

PlanarPose PlanarPose::operator*(const PlanarPose& other) const {
    const double c = std::cos(yaw), s = std::sin(yaw);
    return {x + c * other.x - s * other.y, y + s * other.x + c * other.y,
            std::remainder(yaw + other.yaw, 2 * M_PI)};
}

PlanarPose PlanarPose::inverse() const {
    const double c = std::cos(yaw), s = std::sin(yaw);
    return {-(c * x + s * y), s * x - c * y, -yaw};
}

}  // namespace rgbd_graphslam
