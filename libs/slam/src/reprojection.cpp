#include "rgbd_graphslam/slam/reprojection.h"

namespace rgbd_graphslam {

Measurement measurementOf(const Keypoint& keypoint, double octave_scale,
                          const SensorOptions& sensor) {
    Measurement m;
    m.u = keypoint.u;
    m.v = keypoint.v;
    const double sigma_px = keypoint.aligned ? sensor.aligned_sigma_px : sensor.keypoint_sigma_px;
    m.weight_px = 1 / (sigma_px * octave_scale);
    if (keypoint.depth_m > 0) {
        const double z = keypoint.depth_m;
        m.inverse_depth = 1 / z;
        m.weight_depth = z * z / sensor.depth_noise.sigma(z);
    }
    return m;
}

Eigen::Vector3d residual(const Camera& camera, const Eigen::Vector3d& p, const Measurement& m) {
    const double inverse_z = 1 / p.z();
    return {m.weight_px * (camera.fx * p.x() * inverse_z + camera.cx - m.u),
            m.weight_px * (camera.fy * p.y() * inverse_z + camera.cy - m.v),
            m.weight_depth * (inverse_z - m.inverse_depth)};
}

Eigen::Matrix3d residualJacobian(const Camera& camera, const Eigen::Vector3d& p,
                                 const Measurement& m) {
    const double inverse_z = 1 / p.z(), inverse_z2 = inverse_z * inverse_z;
    Eigen::Matrix3d J;
    J << m.weight_px * camera.fx * inverse_z, 0, -m.weight_px * camera.fx * p.x() * inverse_z2,  //
        0, m.weight_px * camera.fy * inverse_z, -m.weight_px * camera.fy * p.y() * inverse_z2,   //
        0, 0, -m.weight_depth * inverse_z2;
    return J;
}

}  // namespace rgbd_graphslam
