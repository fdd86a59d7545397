#include "rgbd_graphslam/slam/keypoint_measurement.h"

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
        m.weight_depth = 1 / sensor.inverseDepthSigma(z, keypoint.camera);
    }
    return m;
}

}  // namespace rgbd_graphslam
