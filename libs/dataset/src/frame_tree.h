/** ROS's tree of coordinate frames, /tf and /tf_static. */
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "ros_messages.h"

namespace rgbd_graphslam {

/** A frame's name without the slash that ROS once put in front. */
std::string plainFrame(const std::string& frame);

/** Gathers transforms. A frame may have several parents: a robot's odometry and a motion capture
 *  system both place its base. */
class FrameTree {
  public:
    void add(const ros::Transform& transform);

    /** Pose of `frame` in `in` over frames that do not move to each other; nothing when there is no
     *  such way. */
    std::optional<SE3> fixedPose(const std::string& in, const std::string& frame) const;

    /** The frames above `frame`, by name. */
    std::vector<std::string> framesAbove(const std::string& frame) const;

    /** Poses of `frame` in `above`, one for each time at which the frame that was placed most often
     *  on the way was placed; others that move are interpolated. Empty when nothing on the way
     *  moves or `above` is not above it. */
    Trajectory pathOf(const std::string& frame, const std::string& above) const;

    std::vector<std::string> frames() const;

  private:
    /** A frame in one of its parents. */
    struct Link {
        std::string parent;
        bool moves = false;
        Trajectory poses;  // in the recording's order
    };
    /** From a frame up. */
    using Chain = std::vector<const Link*>;

    std::map<std::string, Chain> chainsAbove(const std::string& frame) const;
    static std::optional<SE3> fixedPose(const Chain& chain);
    static std::optional<SE3> poseAt(const Chain& chain, const Link& leading,
                                     const StampedPose& led);

    std::map<std::string, std::vector<Link>> links_;  // by the frame
};

}  // namespace rgbd_graphslam
