/** Stamps of trajectories: shared by the evaluations. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** Without poses whose stamp is repeated: the last of them stays. */
Trajectory withUniqueStamps(const Trajectory& trajectory);

/** In seconds. */
std::vector<double> stampsOf(const Trajectory& trajectory);

/** Index of the value nearest to `wanted` in an ascending list that is not empty; the lower of two
 *  that are equally near. */
std::size_t nearestIndex(const std::vector<double>& ascending, double wanted);

/** \throws Error unless a factor on positions is finite and positive */
void checkScale(double scale);

/** For messages: "0.02 s". */
std::string secondsText(double seconds);

/** For messages: "estimate 1.00 s to 5.00 s (120 poses), truth 7.00 s to 9.00 s (200 poses)". */
std::string spansOf(const Trajectory& estimate, const Trajectory& truth);

}  // namespace rgbd_graphslam
