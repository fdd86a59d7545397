/** The motion that brings one trajectory over another. */
#pragma once
#include <Eigen/Core>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** p -> scale * R p + t. */
struct Similarity {
    double scale = 1;
    SE3 motion;

    Eigen::Vector3d operator*(const Eigen::Vector3d& p) const {
        return scale * (motion.R * p) + motion.t;
    }
    /** A pose moved along: its rotation is turned, its position mapped. */
    SE3 operator*(const SE3& pose) const { return {motion.R * pose.R, *this * pose.t}; }
};

/** Whether the scale is estimated along with the motion. */
enum class AlignmentScale { Fixed, Fitted };

/** The least-squares motion of Umeyama, "Least-squares estimation of transformation parameters
 *  between two point patterns", TPAMI 1991 (with a fixed scale the same as Horn's and Arun's).
 *  \param from, to 3xN positions in meters, column by column of one another, N >= 2
 *  \throws Error for fewer than two points or, when the scale is asked for, for points of `from`
 *          that all coincide */
Similarity alignPoints(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to,
                       AlignmentScale scale = AlignmentScale::Fixed);

}  // namespace rgbd_graphslam
