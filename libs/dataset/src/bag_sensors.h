/** Everything but images of a recording of ROS messages. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bag_survey.h"
#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Where sensors sit, as far as /tf_static tells. */
class Mounts {
  public:
    /** \param reference a frame, "" when there is none
     *  \param T_base_reference its pose on the robot */
    Mounts(const FrameTree& frames, std::string reference, const SE3& T_base_reference)
        : frames_(frames), reference_(std::move(reference)), T_base_reference_(T_base_reference) {}

    /** Pose of a sensor's frame on the robot. */
    std::optional<SE3> of(const std::string& frame) const;

  private:
    const FrameTree& frames_;
    std::string reference_;
    SE3 T_base_reference_;
};

/** Accelerometer and gyroscope, each from the topic nearest by name to `beside` that has it.
 *  \return the accelerometer's topic, else the gyroscope's; nothing when there is neither */
const ImuTopic* takeImu(const BagSurvey& survey, const std::string& beside, RgbdSequence& sequence,
                        std::vector<std::string>& used);

/** Odometry: the first topic of nav_msgs/Odometry in a frame that is not the world, else the path
 *  of the robot's base in a frame of /tf that is named odom. */
void takeOdometry(const BagSurvey& survey, RgbdSequence& sequence, std::vector<std::string>& used);

/** Ground truth: the path of the camera in a frame of /tf that is named after a world, a map or a
 *  motion capture system, and in which it moves. */
void takeTruth(const BagSurvey& survey, const std::string& camera_frame, RgbdSequence& sequence);

/** Laser scans and GPS fixes, all topics of them. */
void takeScans(const BagSurvey& survey, const Mounts& mounts, RgbdSequence& sequence,
               std::vector<std::string>& used);
void takeFixes(const BagSurvey& survey, const Mounts& mounts, RgbdSequence& sequence,
               std::vector<std::string>& used);

}  // namespace rgbd_graphslam
