#include "bag_survey.h"

#include <algorithm>
#include <cmath>

#include "lower_case.h"
#include "rgbd_graphslam/core/progress.h"
#include "ros_images.h"

namespace rgbd_graphslam {
namespace {

/** The entry of that name, made where there is none yet. */
template <class Topic>
Topic& topicIn(std::vector<Topic>& topics, const std::string& name) {
    for (Topic& topic : topics) {
        if (topic.name == name) return topic;
    }
    topics.emplace_back();
    topics.back().name = name;
    return topics.back();
}

/** Drivers that do not stamp leave 0. */
double stampOf(const ros::Header& header, const RecordedMessage& message) {
    return header.stamp_s > 0 ? header.stamp_s : message.recorded_s;
}

/** Gathers what messages say, each kind its own way. */
class Surveying {
  public:
    void take(const RecordedMessage& message) {
        count(message);
        const auto how = takers().find(message.type);
        if (how != takers().end()) (this->*how->second)(message);
    }

    BagSurvey survey;

  private:
    using Taker = void (Surveying::*)(const RecordedMessage&);

    static const std::map<std::string, Taker>& takers() {
        static const std::map<std::string, Taker> all = {
            {"sensor_msgs/Image", &Surveying::takeImage},
            {"sensor_msgs/CompressedImage", &Surveying::takeCompressedImage},
            {"sensor_msgs/CameraInfo", &Surveying::takeCameraInfo},
            {"sensor_msgs/Imu", &Surveying::takeImu},
            {"sensor_msgs/LaserScan", &Surveying::takeScan},
            {"sensor_msgs/NavSatFix", &Surveying::takeFix},
            {"nav_msgs/Odometry", &Surveying::takeOdometry},
            {"tf/tfMessage", &Surveying::takeTransforms},
            {"tf2_msgs/TFMessage", &Surveying::takeTransforms},
            {"geometry_msgs/Transform", &Surveying::takePlainTransform},
            {"realsense2_camera/Extrinsics", &Surveying::takeExtrinsics},
            {"realsense2_camera_msgs/Extrinsics", &Surveying::takeExtrinsics},
            {"std_msgs/Float32", &Surveying::takeNumber}};
        return all;
    }

    void count(const RecordedMessage& message) {
        RecordedTopic& topic = topicIn(survey.topics, message.topic);
        if (topic.count++ == 0) topic.first_s = message.recorded_s;
        topic.type = message.type;
        topic.last_s = message.recorded_s;
    }

    bool isFirst(const RecordedMessage& message) const {
        return survey.topic(message.topic)->count == 1;
    }

    void takeImage(const RecordedMessage& message) {
        if (!isFirst(message)) return;
        const ros::Image image = ros::readImage(message.reader());
        ImageTopic topic{message.topic, lowerCase(image.encoding), plainFrame(image.header.frame)};
        topic.width = static_cast<int>(image.width);
        topic.height = static_cast<int>(image.height);
        topic.largest_m = ros::largestDepth(image);
        survey.images.push_back(topic);
    }

    void takeCompressedImage(const RecordedMessage& message) {
        if (!isFirst(message)) return;
        const ros::CompressedImage image = ros::readCompressedImage(message.reader());
        ImageTopic topic{message.topic, ros::encodingOf(image), plainFrame(image.header.frame)};
        topic.width = ros::sizeOf(image).width;
        topic.height = ros::sizeOf(image).height;
        topic.is_compressed = true;
        topic.is_compressed_depth = ros::isCompressedDepth(image);
        topic.largest_m = ros::largestDepth(image);
        survey.images.push_back(topic);
    }

    void takeCameraInfo(const RecordedMessage& message) {
        if (isFirst(message)) {
            survey.cameras[message.topic] = ros::readCameraInfo(message.reader());
        }
    }

    void takeImu(const RecordedMessage& message) {
        const ros::Imu imu = ros::readImu(message.reader());
        ImuTopic& topic = topicIn(survey.imus, message.topic);
        const double stamp_s = stampOf(imu.header, message);
        topic.frame = plainFrame(imu.header.frame);
        if (imu.linear_acceleration_covariance != -1) {
            topic.acceleration.push_back({stamp_s, imu.linear_acceleration});
        }
        if (imu.angular_velocity_covariance != -1) {
            topic.angular_velocity.push_back({stamp_s, imu.angular_velocity});
        }
    }

    void takeOdometry(const RecordedMessage& message) {
        const ros::Odometry odometry = ros::readOdometry(message.reader());
        if (!odometry.T_parent_child.R.allFinite()) return;
        OdometryTopic& topic = topicIn(survey.odometry, message.topic);
        topic.frame = plainFrame(odometry.header.frame);
        topic.child = plainFrame(odometry.child);
        topic.poses.push_back(
            {stampOf(odometry.header, message), planarPose(odometry.T_parent_child)});
    }

    void takeScan(const RecordedMessage& message) {
        ros::LaserScan scan = ros::readLaserScan(message.reader());
        scan.header.stamp_s = stampOf(scan.header, message);
        topicIn(survey.scans, message.topic).messages.push_back(std::move(scan));
    }

    void takeFix(const RecordedMessage& message) {
        ros::NavSatFix fix = ros::readNavSatFix(message.reader());
        fix.header.stamp_s = stampOf(fix.header, message);
        topicIn(survey.fixes, message.topic).messages.push_back(fix);
    }

    void takeTransforms(const RecordedMessage& message) {
        for (const auto& transform : ros::readTransforms(message.reader())) {
            survey.frames.add(transform);
        }
    }

    void takePlainTransform(const RecordedMessage& message) {
        survey.transforms.emplace(message.topic, ros::readPlainTransform(message.reader()));
    }

    void takeExtrinsics(const RecordedMessage& message) {
        survey.extrinsics.emplace(message.topic, ros::readExtrinsics(message.reader()));
    }

    void takeNumber(const RecordedMessage& message) {
        survey.numbers.emplace(message.topic, ros::readFloat(message.reader()));
    }
};

/** A driver that splits its IMU leaves the other sensor's values at 0. */
void dropIfZero(std::vector<StampedVector>& readings) {
    const bool all_zero = std::all_of(readings.begin(), readings.end(),
                                      [](const auto& reading) { return reading.value.isZero(0); });
    if (all_zero) readings.clear();
}

}  // namespace

const RecordedTopic* BagSurvey::topic(const std::string& name) const {
    for (const RecordedTopic& topic : topics) {
        if (topic.name == name) return &topic;
    }
    return nullptr;
}

std::string toText(const RecordedTopic& topic) {
    return topic.name + " (" + topic.type + ", " + std::to_string(topic.count) + ")";
}

Eigen::Vector3d planarPose(const SE3& T) {
    return {T.t.x(), T.t.y(), std::atan2(T.R(1, 0), T.R(0, 0))};
}

BagSurvey surveyOf(MessageSource& recording) {
    Surveying surveying;
    Progress progress("surveying", 100, "%");
    const std::string missing =
        recording.forEachMessage([&](const RecordedMessage& message, double share) {
            surveying.take(message);
            progress.update(static_cast<std::size_t>(100 * share));
        });
    surveying.survey.missing = missing;
    for (ImuTopic& topic : surveying.survey.imus) {
        dropIfZero(topic.acceleration);
        dropIfZero(topic.angular_velocity);
    }
    return std::move(surveying.survey);
}

}  // namespace rgbd_graphslam
