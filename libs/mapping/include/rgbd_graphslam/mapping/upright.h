/** Which way is up, and where the floor is. */
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/depth_view.h"

namespace rgbd_graphslam {

/** A reading of an accelerometer in the axes of the camera's optical frame, m/s^2: the specific
 *  force, which at rest points up. */
struct SpecificForce {
    double stamp_s;
    Eigen::Vector3d in_camera;
};

/** A point of surface with its normal, which points to the camera. */
struct SurfacePatch {
    Eigen::Vector3d position, normal;
};

/** Mean direction of the specific force in world axes: the camera's own accelerations cancel over a
 *  run, for it ends about as slow as it began. Readings outside the trajectory's time are left out.
 *  \return nothing when there are too few readings, or they disagree */
std::optional<Eigen::Vector3d> upFromAccelerometer(const std::vector<SpecificForce>& readings,
                                                   const Trajectory& trajectory);

/** Patches on a lattice over a depth image, in the camera's axes. Needs rays without strong lens
 *  distortion only in so far as neighbors are neighbors.
 *  \param depth m, 0 = none; readings beyond max_range_m are left out */
std::vector<SurfacePatch> surfacePatches(const cv::Mat1f& depth, const RayTable& rays,
                                         double max_range_m);

/** The direction that most patches near the guess agree on: floor, tables, seats.
 *  \param guess unit vector, \param cone how far it may be wrong, rad
 *  \return nothing when too few patches look that way */
std::optional<Eigen::Vector3d> upFromFloor(const std::vector<SurfacePatch>& patches,
                                           const Eigen::Vector3d& guess, double cone);

/** Heights along `up` of the level surfaces of some size, the lowest first. */
std::vector<double> levelHeights(const std::vector<SurfacePatch>& patches,
                                 const Eigen::Vector3d& up);

/** The frame with z up, the floor at z = 0 and the first camera above the origin looking along +x.
 *  \param up unit vector, \param floor_m height of the floor along it, both in world axes */
SE3 uprightFrame(const Eigen::Vector3d& up, double floor_m, const SE3& T_world_first);

}  // namespace rgbd_graphslam
