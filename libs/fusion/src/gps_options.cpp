#include "rgbd_graphslam/fusion/gps_options.h"

namespace rgbd_graphslam {

void GpsOptions::describe(OptionVisitor& v) {
    v.real("sigma_m", sigma_m, 0, 1000, "m",
           "Standard deviation of a fix, horizontally; 0 = what the receiver tells, else 2");
    v.real("outlier_sigmas", outlier_sigmas, 0.5, 100, "sigmas",
           "Residual at which a fix loses half its weight (Cauchy kernel)");
    v.integer("hold_out_every", hold_out_every, 0, 100, "",
              "Leave out one of so many fixes, to check the others; 0 = use all");
    v.real(
        "wheel_slip_share", wheel_slip_share, 0, 1, "m",
        "Standard deviation of the wheels' way after one meter; 0 = chosen so that fixes predict "
        "each other best");
    v.real("wheel_yaw_share", wheel_yaw_share, 0.001, 2, "rad",
           "Standard deviation of the wheels' heading after a turn of one radian");
    v.real("gyro_noise_rad_sqrt_s", gyro_noise_rad_sqrt_s, 1e-6, 1, "rad",
           "Standard deviation of the gyroscope's heading after one second");
}

}  // namespace rgbd_graphslam
