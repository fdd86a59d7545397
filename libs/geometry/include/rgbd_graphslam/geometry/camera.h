/** The pinhole camera with Brown-Conrady lens distortion. */
#pragma once
#include <Eigen/Core>
#include <array>

namespace rgbd_graphslam {

/** Intrinsics in pixels of an image width x height; optical frame x right, y down, z forward. Pixel
 *  (0, 0) is the center of the top-left pixel. */
struct Camera {
    int width = 640, height = 480;
    double fx = 525, fy = 525, cx = 319.5, cy = 239.5;
    /** OpenCV's and TUM's order: k1, k2, p1, p2, k3. */
    std::array<double, 5> distortion{};

    bool hasDistortion() const;

    /** Optical-frame point (m) to an undistorted pixel; z must be positive. */
    Eigen::Vector2d project(const Eigen::Vector3d& p) const {
        return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy};
    }
    /** Undistorted pixel and depth along z (m) to an optical-frame point. */
    Eigen::Vector3d unproject(double u, double v, double z) const {
        return {(u - cx) * z / fx, (v - cy) * z / fy, z};
    }
    /** Undistorted pixel of a pixel as the sensor saw it (fixed-point iteration); anything, or no
     *  number, where undoesDistortion() does not hold. */
    Eigen::Vector2d undistort(const Eigen::Vector2d& seen) const;
    /** Whether undistort() finds its way to within a pixel all over the image; a lens that folds
     *  the image over, or whose numbers are none, has no inverse. */
    bool undoesDistortion() const;
    /** Inverse of undistort. */
    Eigen::Vector2d distort(const Eigen::Vector2d& undistorted) const;
    bool contains(const Eigen::Vector2d& pixel) const {
        return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= width - 1 &&
               pixel.y() <= height - 1;
    }
};

}  // namespace rgbd_graphslam
