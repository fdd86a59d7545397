/** Laser scans as a text file beside images. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <string>
#include <vector>

namespace rgbd_graphslam {

/** Reads `stamp range range ...` lines (m, from right to left, evenly over the field of view, 0 =
 *  none). Comments tell the scanner: `# aperture_deg = 270`, `# max_range_m = 30`, `# sensor_pose =
 *  [x y z yaw pitch roll]` (m and degrees, on the robot).
 *  \return CObservation2DRangeScan; nothing where there is no such file
 *  \throws Error naming file and line that do not have their form */
std::vector<mrpt::obs::CObservation::Ptr> readScanList(const std::string& path);

}  // namespace rgbd_graphslam
