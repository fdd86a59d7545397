/** What summary.json says of inertial sensor and wheels. */
#pragma once
#include <nlohmann/json.hpp>
#include <optional>

#include "rgbd_graphslam/dataset/sensor_verdict.h"
#include "rgbd_graphslam/slam/motion_summary.h"

namespace rgbd_graphslam {

/** {"imu": ..., "wheels": ...}; null for a sensor that the recording does not have. */
nlohmann::ordered_json motionJson(const MotionSummary& motion,
                                  const std::optional<StampDelay>& imu_delay);

}  // namespace rgbd_graphslam
