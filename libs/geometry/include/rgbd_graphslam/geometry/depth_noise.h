/** How far a structured-light depth reading is from the truth. */
#pragma once

namespace rgbd_graphslam {

/** Axial noise sigma_z(z) = a + b (z - c)^2 in meters; the defaults are Nguyen, Izadi and Lovell,
 *  "Modeling Kinect sensor noise for improved 3D reconstruction and tracking", 3DIMPVT 2012. */
struct DepthNoise {
    double a = 0.0012, b = 0.0019, c = 0.4;
    double sigma(double z) const { return a + b * (z - c) * (z - c); }
};

}  // namespace rgbd_graphslam
