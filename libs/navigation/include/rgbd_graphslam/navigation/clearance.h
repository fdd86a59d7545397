/** How near the robot came to what is really there. */
#pragma once
#include <mrpt/math/TPose2D.h>

#include <vector>

#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/navigation/robot_body.h"

namespace rgbd_graphslam {

/** The true surface within the heights of a robot's body, as seen from above. */
class TrueObstacles {
  public:
    /** \param surface triangles, or points close together; z up, floor at z = 0
     *  \param body_clearance_m the body hangs this high above the floor */
    TrueObstacles(const PlyModel& surface, const RobotBody& body, double body_clearance_m);

    /** From the body to the surface, to 1 cm; negative when they touch, infinite without any.
     *  \param pose in the surface's frame */
    double clearance(const mrpt::math::TPose2D& pose) const;

  private:
    struct Slab {
        std::vector<Eigen::Vector2d> outline;
        double radius_m;                      // of the outline
        std::vector<Eigen::Vector2f> points;  // one a square centimeter
    };
    std::vector<Slab> slabs_;
};

/** A planar pose of the map's frame in the frame of the truth, where the robot stands on the floor
 *  however the map is tilted. */
mrpt::math::TPose2D inTruth(const SE3& T_truth_map, const mrpt::math::TPose2D& pose);

}  // namespace rgbd_graphslam
