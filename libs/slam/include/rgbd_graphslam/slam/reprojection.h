/** The measurement model: where a camera should see a point, and how wrong it is. */
#pragma once
#include <Eigen/Core>

#include "rgbd_graphslam/features/frame.h"
#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/depth_noise.h"
#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

/** A keypoint as the solvers see it: pixel and, when depth was read, inverse depth (which is what a
 *  disparity measures), each with the inverse of its standard deviation. */
struct Measurement {
    double u = 0, v = 0;
    double inverse_depth = 0;  // 1/m; unused when its weight is 0
    double weight_px = 1;      // 1/px
    double weight_depth = 0;   // m; 0 = no depth was read
};

Measurement measurementOf(const Keypoint& keypoint, double octave_scale,
                          const SensorOptions& sensor);

/** 95 % of the chi-square distribution with two and three degrees of freedom. */
constexpr double chi2_pixel = 5.991, chi2_depth = 7.815;
inline double chi2Limit(const Measurement& m) {
    return m.weight_depth > 0 ? chi2_depth : chi2_pixel;
}

/** Whitened residual (predicted - measured) of a point in camera coordinates (m, z > 0): u, v and
 *  inverse depth, the last 0 where no depth was read. */
Eigen::Vector3d residual(const Camera& camera, const Eigen::Vector3d& p_cam, const Measurement& m);

/** Derivative of `residual` by the camera-frame point, 3x3. */
Eigen::Matrix3d residualJacobian(const Camera& camera, const Eigen::Vector3d& p_cam,
                                 const Measurement& m);

/** Nearest depth in front of a camera at which projecting makes sense, m. */
constexpr double nearest_depth_m = 0.05;

}  // namespace rgbd_graphslam
