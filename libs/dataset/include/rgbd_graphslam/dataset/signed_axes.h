/** Axes that are exchanged or reversed. */
#pragma once
#include <Eigen/Core>
#include <vector>

namespace rgbd_graphslam {

/** The 48 matrices with one +1 or -1 in each row and column, the simplest first: the identity, its
 *  negative, the other rotations by rising angle, the negatives of these. */
const std::vector<Eigen::Matrix3d>& signedAxes();

/** Whether axes are reversed so that no rotation brings them to where they should be. */
bool mirrored(const Eigen::Matrix3d& axes);

}  // namespace rgbd_graphslam
