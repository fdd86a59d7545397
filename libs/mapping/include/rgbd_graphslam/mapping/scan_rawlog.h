/** A run as a robot with a level laser scanner and odometry would have recorded it. */
#pragma once
#include <string>

#include "rgbd_graphslam/mapping/map_inputs.h"
#include "rgbd_graphslam/mapping/map_options.h"

namespace rgbd_graphslam {

/** Writes a rawlog of a CObservationOdometry and a CObservation2DRangeScan (see levelScan) for
 *  frames of the last session's trajectory, which is what pf-localization takes. The odometry is
 *  how the base below the camera moves in that trajectory: visual, its loops closed, no wheels.
 *  \param inputs upright: z up, floor at z = 0
 *  \param per_second no more scans than that
 *  \return how many scans were written
 *  \throws Error when a rawlog cannot be read or written */
std::size_t writeScans(const MapInputs& inputs, const MapOptions& options, double per_second,
                       const std::string& path);

}  // namespace rgbd_graphslam
