/** Which of the level surfaces is the floor. */
#pragma once
#include <optional>
#include <vector>

#include "rgbd_graphslam/mapping/upright.h"

namespace rgbd_graphslam {

/** What one keyframe sees, and from where; world axes, m. */
struct SurfaceView {
    Eigen::Vector3d eye;
    std::vector<SurfacePatch> patches;
};

/** A floor and how sure it is. */
struct Floor {
    double height_m = 0;  // along up
    /** Of all patches, those clearly below it, 0 to 1: a floor that mirrors or gives no depth, or
     *  another storey. */
    double share_below = 0;
};

/** More than this below the floor is no noise. */
inline constexpr double most_below_floor = 0.08;

/** The lowest level surface of some size that is not seen through a higher one: mirror images lie
 *  behind the surface that mirrors, and the way to them leads through it.
 *  \param up unit vector
 *  \return nothing when no patch is level */
std::optional<Floor> findFloor(const std::vector<SurfaceView>& views, const Eigen::Vector3d& up);

}  // namespace rgbd_graphslam
