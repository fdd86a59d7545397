#include "rgbd_graphslam/dataset/inertial_reading.h"

#include <array>

namespace rgbd_graphslam {
namespace {
using namespace mrpt::obs;

std::optional<Eigen::Vector3d> measured(const CObservationIMU& imu,
                                        const std::array<TIMUDataIndex, 3>& axes) {
    Eigen::Vector3d value;
    for (int i = 0; i < 3; ++i) {
        // Values that are not marked as present are zeros that nobody measured.
        if (!imu.has(axes[i])) return std::nullopt;
        value[i] = imu.get(axes[i]);
    }
    if (!value.allFinite()) return std::nullopt;
    return value;
}

}  // namespace

std::optional<Eigen::Vector3d> specificForce(const CObservationIMU& imu) {
    return measured(imu, {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC});
}

std::optional<Eigen::Vector3d> angularVelocity(const CObservationIMU& imu) {
    return measured(imu, {IMU_WX, IMU_WY, IMU_WZ});
}

}  // namespace rgbd_graphslam
