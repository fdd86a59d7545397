/** Measurements of points as a depth camera makes them. */
#pragma once
#include "../../support/random_inputs.h"
#include "rgbd_graphslam/estimation/reprojection.h"
#include "rgbd_graphslam/geometry/depth_noise.h"

namespace rgbd_graphslam {

constexpr double pixel_sigma = 0.8;
constexpr DepthNoise depth_noise{0.005, 0.0019, 0.4};

/** \param z depth read, m; 0 = none */
inline Measurement measurementAt(const Eigen::Vector2d& pixel, double z) {
    Measurement m{pixel.x(), pixel.y(), 0, 1 / pixel_sigma, 0};
    if (z <= 0) return m;
    m.inverse_depth = 1 / z;
    m.weight_depth = z * z / depth_noise.sigma(z);
    return m;
}

/** Of a point in camera coordinates, off by as many standard deviations as `noise` says. */
inline Measurement measurementOf(const Eigen::Vector3d& p_cam, const Camera& camera,
                                 RandomInputs& random, double noise = 1, bool with_depth = true) {
    const Eigen::Vector2d off(random.gauss(), random.gauss());
    const double z = p_cam.z() + noise * depth_noise.sigma(p_cam.z()) * random.gauss();
    return measurementAt(camera.project(p_cam) + noise * pixel_sigma * off, with_depth ? z : 0);
}

}  // namespace rgbd_graphslam
