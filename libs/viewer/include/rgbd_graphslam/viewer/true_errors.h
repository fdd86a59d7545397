/** How far an estimate is from the truth, moment by moment. */
#pragma once
#include <Eigen/Core>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** An estimated position and the true one. */
struct TrueError {
    double stamp_s = 0;
    Eigen::Vector3d estimate, truth;  // world, m

    double m() const { return (estimate - truth).norm(); }
};

/** One for every pose whose true place is known, in order of time.
 *  \param truth in the estimate's world, at stamps of the estimate, as truth.txt has it */
std::vector<TrueError> trueErrors(const Trajectory& estimate, const Trajectory& truth);

/** How many times longer than they are lines of errors are seen in a view of the whole scene, their
 *  root mean square being 1 % of it: 1, 2, 5, 10, ..., 100.
 *  \param scene_m diagonal of the scene */
int visibleScale(const std::vector<TrueError>& errors, double scene_m);

}  // namespace rgbd_graphslam
