/** The path of a camera from ROS's tree of coordinate frames. */
#pragma once
#include <map>
#include <string>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "ros_messages.h"

namespace rgbd_graphslam {

/** Gathers transforms; each frame has one parent. */
class TfPath {
  public:
    void add(const ros::Transform& transform);

    /** Poses of `frame` in the world, the frame that has no parent: one for each time at which the
     *  frame just below the world was placed, the frames between at their latest. Empty when the
     *  world is not known to move. */
    Trajectory pathOf(const std::string& frame) const;

  private:
    struct Link {
        std::string parent;
        Trajectory poses;  // of the frame in its parent, in the bag's order
    };
    std::map<std::string, Link> links_;
};

}  // namespace rgbd_graphslam
