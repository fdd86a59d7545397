#include "bag_calibration.h"

#include <algorithm>
#include <cmath>

#include "lower_case.h"
#include "ros_lens.h"

namespace rgbd_graphslam {
namespace {

/** The last part of a frame's name, "base_link" of "robot1/base_link". */
std::string lastPart(const std::string& frame) {
    return frame.substr(frame.rfind('/') + 1);
}

/** The reference of librealsense's extrinsics in a stream: they map from it to the stream. */
std::optional<SE3> streamFromReference(const BagSurvey& survey, const std::string& stream) {
    const auto found = survey.transforms.find(stream + "/tf/0");
    if (found == survey.transforms.end()) return std::nullopt;
    return found->second;
}

std::optional<SE3> betweenStreams(const BagSurvey& survey, const std::string& to,
                                  const std::string& from) {
    const auto T_to = streamFromReference(survey, to), T_from = streamFromReference(survey, from);
    if (!T_to || !T_from) return std::nullopt;
    return *T_to * T_from->inverse();
}

}  // namespace

bool namesBase(const std::string& frame) {
    return lastPart(frame) == "base_link" || lastPart(frame) == "base_footprint";
}

bool isRectified(const std::string& topic) {
    return contains(lowerCase(topic), "image_rect");
}

Intrinsics pinholeOf(const ros::CameraInfo& info, bool rectified) {
    Intrinsics camera{static_cast<int>(info.width),
                      static_cast<int>(info.height),
                      info.K[0],
                      info.K[4],
                      info.K[2],
                      info.K[5],
                      {}};
    const bool finite = std::all_of(info.P.begin(), info.P.end(),
                                    [](double value) { return std::isfinite(value); });
    if (rectified && finite && info.P[0] > 0 && info.P[5] > 0) {
        camera.fx = info.P[0];
        camera.fy = info.P[5];
        camera.cx = info.P[2];
        camera.cy = info.P[6];
    }
    return camera;
}

std::optional<Lens> lensOf(const ros::CameraInfo& info, bool rectified) {
    return rectified ? Lens() : lensByRosName(info.distortion_model, info.D);
}

std::optional<SE3> colorFromDepth(const BagSurvey& survey, const ImageChoice& images) {
    const std::string color = librealsenseStream(images.color.name);
    const std::string depth = librealsenseStream(images.depth.name);
    if (!color.empty() && !depth.empty()) return betweenStreams(survey, color, depth);
    if (images.color.frame != images.depth.frame) {
        const auto T = survey.frames.fixedPose(images.color.frame, images.depth.frame);
        if (T) return T;
    }
    for (const auto& [topic, T_color_depth] : survey.extrinsics) {
        if (contains(topic, "depth_to_color")) return T_color_depth;
    }
    return std::nullopt;
}

std::string baseOf(const FrameTree& frames, const std::string& frame) {
    for (const std::string wanted : {"base_footprint", "base_link"}) {
        for (const std::string& above : frames.framesAbove(frame)) {
            if (lastPart(above) == wanted && frames.fixedPose(above, frame)) return above;
        }
    }
    return "";
}

std::optional<SE3> colorFromImu(const BagSurvey& survey, const ImageTopic& color,
                                const ImuTopic& imu) {
    const std::string stream = librealsenseStream(color.name), ending = "/imu/data";
    if (!stream.empty() && contains(imu.name, ending)) {
        return betweenStreams(survey, stream, imu.name.substr(0, imu.name.find(ending)));
    }
    if (!imu.frame.empty()) {
        const auto T = survey.frames.fixedPose(color.frame, imu.frame);
        if (T) return T;
    }
    if (contains(lastPart(imu.frame), "optical_frame")) return SE3();
    return std::nullopt;
}

}  // namespace rgbd_graphslam
