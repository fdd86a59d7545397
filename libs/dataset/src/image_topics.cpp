#include "image_topics.h"

#include <algorithm>
#include <cmath>

#include "lower_case.h"
#include "rgbd_graphslam/core/error.h"
#include "ros_images.h"

namespace rgbd_graphslam {
namespace {

/** Calibrations that agree so far are one, share of the focal length. */
constexpr double same_calibration = 0.02;
/** Cameras nearer than this are one, m and rad. */
constexpr double same_place = 1e-3;

bool namesAny(const std::string& name, const std::vector<std::string>& words) {
    const std::string lower = lowerCase(name);
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return contains(lower, word); });
}

bool isNamedInfrared(const std::string& name) {
    return namesAny(name, {"infra", "/ir/", "/ir_", "_ir/", "thermal", "fisheye"});
}

/** Pictures with depth's encodings that are none. */
bool isNamedOtherwise(const std::string& name) {
    return isNamedInfrared(name) || namesAny(name, {"disparity", "confidence", "label", "mask"});
}

bool isDepth(const ImageTopic& image) {
    if (image.is_compressed_depth) return true;
    return ros::isDepthEncoding(image.encoding) && !isNamedOtherwise(image.name);
}

bool isColor(const ImageTopic& image) {
    if (isDepth(image) || image.is_compressed_depth) return false;
    return ros::isColorEncoding(image.encoding) || ros::isGrayEncoding(image.encoding) ||
           (image.is_compressed && !ros::isDepthEncoding(image.encoding));
}

int rankOfColor(const ImageTopic& image) {
    int rank = 0;
    if (!ros::isGrayEncoding(image.encoding)) rank += 8;
    if (isNamedOtherwise(image.name)) rank -= 16;
    if (namesAny(image.name, {"depth"})) rank -= 4;
    if (namesAny(image.name, {"color", "rgb"})) rank += 2;
    if (!image.is_compressed) rank += 1;
    return rank;
}

int rankOfDepth(const BagSurvey& survey, const ImageTopic& color, const ImageTopic& depth) {
    int rank = 0;
    if (isRegistered(survey, color, depth)) rank += 8;
    if (namesAny(depth.name, {"depth"})) rank += 4;
    if (depth.encoding != "mono16") rank += 2;
    if (!depth.is_compressed) rank += 1;
    return rank;
}

/** The first of the highest rank. */
template <class Accept, class Rank>
const ImageTopic* bestOf(const std::vector<ImageTopic>& images, Accept accept, Rank rank) {
    const ImageTopic* best = nullptr;
    for (const ImageTopic& image : images) {
        if (accept(image) && (!best || rank(image) > rank(*best))) best = &image;
    }
    return best;
}

const ImageTopic& topicNamed(const BagSurvey& survey, const std::string& bag,
                             const std::string& name) {
    for (const ImageTopic& image : survey.images) {
        if (image.name == name) return image;
    }
    throw Error(
        "'" + bag + "' has no image topic '" + name + "'; its topics: " + topicList(survey.topics),
        "check --color-topic and --depth-topic");
}

[[noreturn]] void refuse(const BagSurvey& survey, const std::string& bag, const std::string& kind) {
    const std::string topics = topicList(survey.topics);
    throw Error("'" + bag + "' holds no " + kind + " images; " +
                    (topics.empty() ? "it has no messages" : "its topics: " + topics),
                "give a recording of an RGB-D camera, or write the other sensors alone with "
                "--no-camera");
}

/** Names of the topic that may hold an image topic's calibration, best first. */
std::vector<std::string> infoTopics(const std::string& image) {
    const std::string stream = librealsenseStream(image);
    if (!stream.empty()) return {stream + "/info/camera_info"};
    std::vector<std::string> names;
    std::string name = image;
    for (int levels = 0; levels < 2 && name.find('/') != std::string::npos; ++levels) {
        name.resize(name.rfind('/'));
        names.push_back(name + "/camera_info");
    }
    return names;
}

bool isFor(const ros::CameraInfo& info, const ImageTopic& image) {
    const bool is_calibrated = std::isfinite(info.K[0]) && std::isfinite(info.K[4]) &&
                               std::isfinite(info.K[2]) && std::isfinite(info.K[5]);
    return is_calibrated && info.K[0] > 0 && info.K[4] > 0 &&
           static_cast<int>(info.width) == image.width &&
           static_cast<int>(info.height) == image.height;
}

bool agree(const ros::CameraInfo& a, const ros::CameraInfo& b) {
    const double most = same_calibration * a.K[0];
    return a.width == b.width && a.height == b.height && std::abs(a.K[0] - b.K[0]) < most &&
           std::abs(a.K[4] - b.K[4]) < most && std::abs(a.K[2] - b.K[2]) < most &&
           std::abs(a.K[5] - b.K[5]) < most;
}

bool areAtOnePlace(const BagSurvey& survey, const ImageTopic& color, const ImageTopic& depth) {
    if (!librealsenseStream(color.name).empty()) return false;
    if (!color.frame.empty() && color.frame == depth.frame) return true;
    const auto T = survey.frames.fixedPose(color.frame, depth.frame);
    return T && T->t.norm() < same_place && T->angle() < same_place;
}

}  // namespace

std::string librealsenseStream(const std::string& topic) {
    const std::string ending = "/image/data";
    const bool is_one = topic.rfind("/device_", 0) == 0 && topic.size() > ending.size() &&
                        topic.compare(topic.size() - ending.size(), ending.size(), ending) == 0;
    return is_one ? topic.substr(0, topic.size() - ending.size()) : "";
}

std::optional<ros::CameraInfo> cameraInfoOf(const BagSurvey& survey, const ImageTopic& image) {
    for (const std::string& name : infoTopics(image.name)) {
        const auto info = survey.cameras.find(name);
        if (info != survey.cameras.end() && isFor(info->second, image)) return info->second;
    }
    if (!librealsenseStream(image.name).empty()) return std::nullopt;
    for (const auto& [name, info] : survey.cameras) {
        if (plainFrame(info.header.frame) == image.frame && isFor(info, image)) return info;
    }
    return std::nullopt;
}

bool isRegistered(const BagSurvey& survey, const ImageTopic& color, const ImageTopic& depth) {
    if (namesAny(depth.name, {"aligned_depth_to_color", "depth_registered", "depth_to_rgb"})) {
        return true;
    }
    if (!areAtOnePlace(survey, color, depth)) return false;
    const auto of_color = cameraInfoOf(survey, color), of_depth = cameraInfoOf(survey, depth);
    return !of_color || !of_depth || agree(*of_color, *of_depth);
}

ImageChoice chooseImages(const BagSurvey& survey, const std::string& bag,
                         const std::string& color_topic, const std::string& depth_topic) {
    const ImageTopic* color = color_topic.empty() ? bestOf(survey.images, isColor, rankOfColor)
                                                  : &topicNamed(survey, bag, color_topic);
    if (!color) refuse(survey, bag, "color");
    const auto rank = [&](const ImageTopic& depth) { return rankOfDepth(survey, *color, depth); };
    const ImageTopic* depth = depth_topic.empty() ? bestOf(survey.images, isDepth, rank)
                                                  : &topicNamed(survey, bag, depth_topic);
    if (!depth) refuse(survey, bag, "depth");
    return {*color, *depth};
}

std::string topicList(const std::vector<RecordedTopic>& topics) {
    std::string list;
    for (const RecordedTopic& topic : topics) {
        list += (list.empty() ? "" : ", ") + toText(topic);
    }
    return list;
}

}  // namespace rgbd_graphslam
