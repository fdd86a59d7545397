/** Whether a pose that landmarks give is to be believed. */
#pragma once
#include "motion_prior.h"
#include "rgbd_graphslam/slam/tracker.h"

namespace rgbd_graphslam {

enum class Verdict {
    Believed,
    /** It may be right, but leaves a direction open: good to go on from, not to build on. */
    Uncertain,
    /** The camera cannot have moved so. */
    Rejected,
};

/** Judges a pose by what its landmarks hold (the standard deviation of the weakest direction) and
 * by the motion since the frame before: few landmarks must agree with it, many may not contradict
 * it. \param T_predicted_cam from where the motion puts the camera to where the landmarks do \param
 * prior up to the frame */
Verdict judge(const LocatedFrame& located, const SE3& T_predicted_cam, const MotionPrior& prior);

}  // namespace rgbd_graphslam
