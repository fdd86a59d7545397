/** How accurate a GPS fix is, as rawlogs keep it. */
#pragma once

namespace rgbd_graphslam {

/** MRPT's GGA messages tell a horizontal dilution of precision; times this error of a single range
 *  it is the horizontal standard deviation, of both axes together, m. */
inline constexpr double gps_range_error_m = 2;

}  // namespace rgbd_graphslam
