/** Whether a scanner's field of view is what its scans claim. */
#pragma once
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/estimation/wheel_preintegration.h"

namespace rgbd_graphslam {

/** A scan and where the wheels tell that it was taken. */
struct PlacedScan {
    mrpt::obs::CObservation2DRangeScan::Ptr scan;
    PlanarPose T_start_base;
};

/** What turns and walls tell of the aperture. */
struct ApertureVerdict {
    /** Turns by scans over turns by wheels, with the aperture as recorded: 1 where all is well. */
    double turn_ratio = 1;
    /** What the recorded aperture must be multiplied by. */
    double factor = 1;
    /** What to tell the user; empty when all is well or nothing can be told. */
    std::string warning;
};

/** Aligns scans between which the robot turned. An aperture of twice the true one makes them turn
 *  twice as far and bends straight walls: it is corrected by a factor of 2 where both become right.
 *  Where walls are straight but turns differ it is the odometry that is wrong.
 *  \param scans in order of time */
ApertureVerdict checkAperture(const std::vector<PlacedScan>& scans);

}  // namespace rgbd_graphslam
