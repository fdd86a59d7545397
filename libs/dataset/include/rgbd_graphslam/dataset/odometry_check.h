/** Whether wheels go where the camera goes. */
#pragma once
#include <vector>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"
#include "rgbd_graphslam/dataset/sensor_verdict.h"
#include "rgbd_graphslam/dataset/tracked_motion.h"

namespace rgbd_graphslam {

/** A verdict on wheel odometry, whose headings may be scaled apart from its positions. */
struct OdometryVerdict : SensorVerdict {
    /** Headings are so many times too large; negative when they turn the other way. */
    double heading_factor = 1;
};

/** Compares the way and the turning over spans of half a second and more: the heading's factor by
 *  least squares, then the signed axes of x and y with the highest correlation, then the factor of
 *  the way as the median over spans. A factor that the unit of depth would explain as well is told
 *  as such.
 *  \param readings x, y (m), heading (rad, in any turn)
 *  \param base poses of the robot's base: x forward, y left, z up
 *  \param depth_units of the recording's depth images, per meter
 *  \return a fault only where another hypothesis explains the readings far better */
OdometryVerdict checkOdometry(const std::vector<StampedVector>& readings,
                              const TrackedStretches& base, double depth_units);

}  // namespace rgbd_graphslam
