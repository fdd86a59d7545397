/** Whether a gyroscope turns as the camera does. */
#pragma once
#include <vector>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"
#include "rgbd_graphslam/dataset/sensor_verdict.h"
#include "rgbd_graphslam/dataset/tracked_motion.h"

namespace rgbd_graphslam {

/** Compares mean angular velocities over spans of some 0.15 s, a constant bias apart: the signed
 *  axes and the delay with the highest correlation, then the factor by least squares.
 *  \param readings rad/s, in the gyroscope's axes
 *  \param gyroscope poses of the gyroscope as the recording says it is mounted, in any world
 *  \return a fault only where another hypothesis explains the readings far better; Undecided when
 *          the camera hardly turned */
SensorVerdict checkGyroscope(const std::vector<StampedVector>& readings,
                             const TrackedStretches& gyroscope);

}  // namespace rgbd_graphslam
