/** What a running SLAM tells a viewer. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** Tracked: shows a landmark; new: shows none yet; lost: where a landmark of the frame before
 * should be but was not found. */
enum class FeatureState : std::uint8_t { Tracked, New, Lost };

/** A keypoint to be drawn over the image. */
struct LiveFeature {
    float u = 0, v = 0;  // px of the image as the sensor saw it
    FeatureState state = FeatureState::New;
};

/** One line of the plots. */
struct LiveStatistic {
    double stamp_s = 0;
    float frame_ms = 0;  // wall time of tracking it
    int inliers = 0;
    bool lost = false;
};

/** A frame, with images reduced to what a window shows, or a keyframe, with images reduced to what
 *  its part of the map needs. */
struct LiveFrame {
    /** Whether it is one that the viewer has asked for; else a keyframe for the map alone, without
     *  features and statistics. */
    bool is_picture = true;
    double stamp_s = 0;
    bool lost = false;
    SE3 T_world_cam;
    /** The keyframe it became, or -1. */
    int keyframe = -1;
    Intrinsics camera;  // of the images as the sensor made them
    std::vector<LiveFeature> features;
    /** Of all frames since the last picture, this one included. */
    std::vector<LiveStatistic> statistics;
    /** CV_8UC3 (BGR) and CV_16UC1: every n-th pixel of every n-th row, from the first on. As they
     *  are, since packing them would cost SLAM more than sending them. */
    cv::Mat color, depth;
    int step = 1;
    double depth_unit_m = 0.001;
};

/** Everything that a closed loop may have moved. */
struct LiveMap {
    Trajectory path, keyframes;
    std::vector<std::pair<int, int>> loops, covisibility;  // keyframes
};

using LiveMessage = std::variant<LiveFrame, LiveMap>;

/** Reduces the images of a frame into the message, to 320 columns at most of a picture, to 96 of
 *  another; of a gray camera the three colors are the same. */
void putImages(const RgbdImage& image, LiveFrame& frame);

/** The camera of the images in the message.
 *  \throws Error when it holds no two images of one size */
Camera imageCamera(const LiveFrame& frame);

/** For machines of one kind: both ends run on the same one. */
std::string encode(const LiveMessage& message);

/** \throws Error when the bytes are no whole message */
LiveMessage decode(const std::string& bytes);

}  // namespace rgbd_graphslam
