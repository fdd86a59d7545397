/** Small views of a room whose truth is exact. */
#pragma once
#include <cmath>

#include "rgbd_graphslam/features/dense_view.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A box painted with waves, cast ray by ray; y down as in a camera. */
class DenseRoom {
  public:
    DenseView view(const SE3& T_room_cam) const {
        DenseView view;
        view.camera = Camera().shrunk(8);
        for (int v = 0; v < view.camera.height; ++v) {
            for (int u = 0; u < view.camera.width; ++u) {
                const Eigen::Vector3d ray = T_room_cam.R * view.camera.unproject(u, v, 1);
                const double z = depthAlong(T_room_cam.t, ray);
                view.depth_m.push_back(static_cast<float>(z));
                view.gray.push_back(grayAt(T_room_cam.t + z * ray));
            }
        }
        return view;
    }

  private:
    double depthAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) const {
        double nearest = 1e9;
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(ray[axis]) < 1e-12) continue;
            const double wall = ray[axis] > 0 ? half_size_[axis] : -half_size_[axis];
            nearest = std::min(nearest, (wall - origin[axis]) / ray[axis]);
        }
        return nearest;
    }

    static float grayAt(const Eigen::Vector3d& p) {
        const double waves = std::sin(4.1 * p.x() + 1.3 * p.y()) +
                             std::sin(5.3 * p.y() - 2.1 * p.z()) +
                             std::sin(3.7 * p.z() + 2.9 * p.x() + 1);
        return static_cast<float>(128 + 35 * waves);
    }

    const Eigen::Vector3d half_size_{2.0, 1.3, 2.5};
};

/** Towards a corner of walls and floor, then turned about the vertical. */
inline SE3 lookingIntoTheCorner(double turn_rad, const Eigen::Vector3d& at) {
    return {rotationExp({0, 0.7 + turn_rad, 0}) * rotationExp({-0.3, 0, 0}), at};
}

}  // namespace rgbd_graphslam
