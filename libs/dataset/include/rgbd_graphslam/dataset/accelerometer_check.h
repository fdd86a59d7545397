/** Whether an accelerometer feels gravity and the camera's motion. */
#pragma once
#include <optional>
#include <vector>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"
#include "rgbd_graphslam/dataset/sensor_verdict.h"
#include "rgbd_graphslam/dataset/tracked_motion.h"

namespace rgbd_graphslam {

/** Unit by the median length; axes and sign by turning the readings to the world with the tracked
 *  rotation: what remains after the camera's own acceleration is constant. The acceleration comes
 *  from three positions, and the readings are averaged with the triangle that makes this exact.
 *  A sensor that is negated is told from one that is not by the motion, not by gravity.
 *  \param readings m/s^2, specific force in the accelerometer's axes
 *  \param accelerometer poses of the accelerometer as the recording says it is mounted
 *  \return a fault only where another hypothesis explains the readings far better */
SensorVerdict checkAccelerometer(const std::vector<StampedVector>& readings,
                                 const TrackedStretches& accelerometer);

/** How many times larger the camera's positions would have to be for their accelerations to be the
 *  accelerometer's: 1 when the depth has the right unit.
 *  \return nothing when the camera moved too evenly to tell */
std::optional<double> scaleByAccelerometer(const std::vector<StampedVector>& readings,
                                           const TrackedStretches& accelerometer);

}  // namespace rgbd_graphslam
