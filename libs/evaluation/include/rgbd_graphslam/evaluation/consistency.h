/** Whether a run errs as much as it says it does. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/evaluation/report.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** A pose with what its run claims about it. */
struct ClaimedPose {
    double stamp_s = 0;
    /** The run calls it tracked or recovered: located by landmarks, and believed. */
    bool believed = false;
    SE3 T_world_cam;
    /** Standard deviations along and about the camera's axes: x y z in m, then rad. */
    Vector6d sigma = Vector6d::Zero();
};

/** Of the frames that a run believes. */
struct Consistency {
    std::size_t poses = 0;     // with a pose and a truth
    std::size_t believed = 0;  // of them
    /** Normalized error squared, the mean over frames of the sum over the six components of
     *  (error / sigma)^2: 6 where claims are right, more where they are too small. */
    double nees = 0;
    /** Share of frames whose sum lies between 1.24 and 14.45, 95 % of chi-square with 6 degrees. */
    double nees_in_band = 0;
    /** Share of frames with all six components within 3 sigma. */
    double within_3_sigma = 0;
    double worst_m = 0, worst_rad = 0;
    /** Most that the motion between two frames in a row, both believed, differs from the truth. */
    double largest_jump_m = 0;
};

/** Standard deviations of each component of the true poses. */
struct TruthAccuracy {
    double sigma_m = 0, sigma_rad = 0;
};

/** Errors are those left when the believed poses lie over the truth by least squares, a radian
 *  counting as half a meter or so. The truth is interpolated.
 *  \param accuracy of the truth, whose variance is added to the claimed one
 *  \throws Error when fewer than two believed poses have a truth */
Consistency evaluateConsistency(const std::vector<ClaimedPose>& poses, const Trajectory& truth,
                                const TruthAccuracy& accuracy = {});

/** trajectory.txt and frames.csv of a run's folder.
 *  \throws Error naming the file and line where one is missing or damaged, or tells no standard
 *          deviations, as earlier versions did not */
std::vector<ClaimedPose> readClaimedPoses(const std::string& run_folder);

Report reportOf(const std::string& run, const Consistency& consistency);

}  // namespace rgbd_graphslam
