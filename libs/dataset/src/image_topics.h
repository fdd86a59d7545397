/** Which of a recording's image topics are its RGB-D camera. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bag_survey.h"

namespace rgbd_graphslam {

/** Color and depth of one camera. */
struct ImageChoice {
    ImageTopic color, depth;
};

/** The topic of a camera's calibration beside an image topic, and the calibration, where it was
 *  recorded; else one for the same frame. Calibrations for images of another size do not count. */
std::optional<ros::CameraInfo> cameraInfoOf(const BagSurvey& survey, const ImageTopic& image);

/** Whether depth has been registered to color, by the topic's name or by equal calibrations. */
bool isRegistered(const BagSurvey& survey, const ImageTopic& color, const ImageTopic& depth);

/** Color before gray, visible light before infrared, depth registered to color before raw, raw
 *  pixels before compressed ones, the first recorded before others.
 *  \param color_topic, depth_topic names that are asked for, or empty
 *  \throws Error that lists the recording's topics when a topic is missing */
ImageChoice chooseImages(const BagSurvey& survey, const std::string& bag,
                         const std::string& color_topic, const std::string& depth_topic);

/** "sensor_msgs/Image" topics that were not chosen and further such lists, in one line. */
std::string topicList(const std::vector<RecordedTopic>& topics);

/** A topic of librealsense's recorder, "/device_0/sensor_0/Depth_0/image/data": what is in front of
 *  "image/data"; empty for others. */
std::string librealsenseStream(const std::string& topic);

}  // namespace rgbd_graphslam
