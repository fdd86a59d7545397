/** What a recording of ROS messages holds, without the pixels. */
#pragma once
#include <map>
#include <string>
#include <vector>

#include "frame_tree.h"
#include "message_source.h"
#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Messages of one name and type, in the order in which they first came. */
struct RecordedTopic {
    std::string name, type;
    std::size_t count = 0;
    double first_s = 0, last_s = 0;
};

/** A topic of images, as its first one is. */
struct ImageTopic {
    std::string name;
    /** In lower case, e.g. "rgb8"; of compressed images what their format begins with. */
    std::string encoding;
    std::string frame;
    int width = 0, height = 0;
    bool is_compressed = false, is_compressed_depth = false;
    /** The largest reading of the first image, for floating-point depth, m. */
    double largest_m = 0;
};

struct ImuTopic {
    std::string name, frame;
    std::vector<StampedVector> acceleration, angular_velocity;
};

struct OdometryTopic {
    std::string name, frame, child;
    /** x, y, heading. */
    std::vector<StampedVector> poses;
};

template <class Message>
struct TopicOf {
    std::string name;
    std::vector<Message> messages;
};

struct BagSurvey {
    std::vector<RecordedTopic> topics;
    std::vector<ImageTopic> images;
    std::vector<ImuTopic> imus;
    std::vector<OdometryTopic> odometry;
    std::vector<TopicOf<ros::LaserScan>> scans;
    std::vector<TopicOf<ros::NavSatFix>> fixes;
    /** By topic, the first of each. */
    std::map<std::string, ros::CameraInfo> cameras;
    std::map<std::string, SE3> extrinsics, transforms;
    std::map<std::string, float> numbers;
    FrameTree frames;
    /** What is missing of a recording that was not closed, or empty. */
    std::string missing;

    const RecordedTopic* topic(const std::string& name) const;
};

/** "/imu (sensor_msgs/Imu, 11865)" */
std::string toText(const RecordedTopic& topic);

/** Reads a recording from front to back; shows progress.
 *  \throws Error as MessageSource does, and for an image that is not whole */
BagSurvey surveyOf(MessageSource& recording);

/** x, y and heading of a pose. */
Eigen::Vector3d planarPose(const SE3& T);

}  // namespace rgbd_graphslam
