/** ROS's messages of further sensors as MRPT's observations. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <string>

#include "ros_messages.h"

namespace rgbd_graphslam {

/** A CObservation2DRangeScan; its readings lie evenly around the sensor's x axis, so a scan that
 *  looks elsewhere turns the sensor's pose. Readings out of range are invalid. */
mrpt::obs::CObservation::Ptr toObservation(const ros::LaserScan& scan, const std::string& label,
                                           const SE3& T_base_laser);

/** A CObservationGPS with a GGA message, as MRPT's bridge to ROS makes it. */
mrpt::obs::CObservation::Ptr toObservation(const ros::NavSatFix& fix, const std::string& label,
                                           const SE3& T_base_antenna);

}  // namespace rgbd_graphslam
