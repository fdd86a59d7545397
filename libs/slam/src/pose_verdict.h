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

/** A motion since the frame before, and how far it is to be believed. */
struct SupposedMotion {
    /** From where the motion puts the camera to where the landmarks do. */
    SE3 T_predicted_cam;
    /** Up to the frame. */
    MotionPrior prior;
};

/** Judges a pose by what its landmarks hold (the standard deviation of the weakest direction) and
 *  by the motion since the frame before: few landmarks must agree with what is measured, many need
 *  only be possible. Wheels may slip or leap; many landmarks outrank them.
 *  \param measured by wheels, where there are any
 *  \param inertial as anything moves that has a mass */
Verdict judge(const LocatedFrame& located, const SupposedMotion& measured,
              const SupposedMotion& inertial);

}  // namespace rgbd_graphslam
