#include "rgbd_graphslam/features/frame_builder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/features/stereo_matcher.h"
#include "rgbd_graphslam/geometry/stereo_depth.h"

namespace rgbd_graphslam {
namespace {

constexpr int fewest_readings = 3;

std::string sizeText(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

void checkImage(const cv::Mat& image, int type, const char* what, const Camera& camera,
                double stamp) {
    if (image.type() == type && image.cols == camera.width && image.rows == camera.height) return;
    throw Error("frame at " + std::to_string(stamp) + " s: the " + what + " image is " +
                    sizeText(image.cols, image.rows) + " of OpenCV type " +
                    std::to_string(image.type()) + ", the camera has " +
                    sizeText(camera.width, camera.height),
                "import the sequence again with the right camera");
}

/** Whether a corner's surroundings, which its place and descriptor depend on, touch what is left
 *  out. */
bool isLeftOut(const cv::Mat& mask, const Corner& corner, double scale_factor) {
    constexpr double reach_px = 4;
    const double reach = reach_px * std::pow(scale_factor, corner.octave);
    for (const double du : {-reach, 0., reach}) {
        for (const double dv : {-reach, 0., reach}) {
            const int u =
                std::clamp(static_cast<int>(std::lround(corner.u + du)), 0, mask.cols - 1);
            const int v =
                std::clamp(static_cast<int>(std::lround(corner.v + dv)), 0, mask.rows - 1);
            if (mask.at<std::uint8_t>(v, u) == 0) return true;
        }
    }
    return false;
}

/** Without the corners that the mask leaves out. */
OrbFeatures inMask(OrbFeatures features, const cv::Mat& mask, double scale_factor) {
    if (mask.empty()) return features;
    OrbFeatures rest;
    for (std::size_t i = 0; i < features.corners.size(); ++i) {
        if (isLeftOut(mask, features.corners[i], scale_factor)) continue;
        rest.corners.push_back(features.corners[i]);
        rest.descriptors.push_back(features.descriptors[i]);
        rest.patches.push_back(features.patches[i]);
    }
    return rest;
}

/** Depth (m) at a pixel; 0 = none. */
using DepthAt = std::function<float(float u, float v)>;

DepthAt stereoDepth(const RgbdImage& image, const FeatureOptions& options) {
    const double nearest_m = std::max(options.depth_min_m, 1e-3);
    const auto matcher = std::make_shared<const StereoMatcher>(
        image.gray, image.right,
        largestDisparity(image.gray.cols, image.disparity_m_px, nearest_m));
    return [matcher, disparity_m_px = image.disparity_m_px, farthest_m = options.farthestDepthM()](
               float u, float v) {
        const auto disparity = matcher->disparityAt(u, v);
        const double z = disparity ? disparity_m_px / *disparity : 0;
        return z <= farthest_m ? static_cast<float>(z) : 0;
    };
}

DepthAt depthOf(const RgbdImage& image, const FeatureOptions& options) {
    if (!image.right.empty()) return stereoDepth(image, options);
    return [&image, &options](float u, float v) {
        return foregroundDepth(image.depth, image.depth_unit_m, u, v, options);
    };
}

void checkImages(const RgbdImage& image, const Camera& camera) {
    checkImage(image.gray, CV_8UC1, "gray", camera, image.stamp_s);
    if (image.right.empty()) {
        checkImage(image.depth, CV_16UC1, "depth", camera, image.stamp_s);
    } else {
        checkImage(image.right, CV_8UC1, "right", camera, image.stamp_s);
    }
}

}  // namespace

float foregroundDepth(const cv::Mat& depth, double depth_unit_m, float u, float v,
                      const FeatureOptions& options) {
    const int x = static_cast<int>(std::lround(u)), y = static_cast<int>(std::lround(v));
    const int x0 = std::max(x - 1, 0), x1 = std::min(x + 1, depth.cols - 1);
    const int y0 = std::max(y - 1, 0), y1 = std::min(y + 1, depth.rows - 1);
    int nearest = 65536;
    for (int j = y0; j <= y1; ++j) {
        const auto* row = depth.ptr<std::uint16_t>(j);
        for (int i = x0; i <= x1; ++i) {
            if (row[i] && row[i] < nearest) nearest = row[i];
        }
    }
    const double farthest = nearest * (1 + options.depth_edge_step * nearest * depth_unit_m);
    int readings = 0, sum = 0;
    for (int j = y0; j <= y1; ++j) {
        const auto* row = depth.ptr<std::uint16_t>(j);
        for (int i = x0; i <= x1; ++i) {
            if (!row[i] || row[i] > farthest) continue;
            ++readings;
            sum += row[i];
        }
    }
    if (readings < fewest_readings) return 0;
    const double z = depth_unit_m * sum / readings;
    return z >= options.depth_min_m && z <= options.farthestDepthM() ? static_cast<float>(z) : 0;
}

FrameBuilder::FrameBuilder(const FeatureOptions& options, const Camera& camera)
    : options_(options),
      camera_(camera),
      extractor_(options),
      dense_(std::make_shared<DenseViewBuilder>(camera)) {}

Frame FrameBuilder::build(const RgbdImage& image) const {
    checkImages(image, camera_);
    Frame frame;
    frame.stamp_s = image.stamp_s;
    frame.view = std::async(std::launch::deferred, [dense = dense_, image] {
                     return dense->build(image);
                 }).share();
    if (!image.mask.empty()) checkImage(image.mask, CV_8UC1, "mask", camera_, image.stamp_s);
    OrbFeatures features =
        inMask(extractor_.extract(image.gray), image.mask, options_.scale_factor);
    frame.descriptors = std::move(features.descriptors);
    frame.patches = std::move(features.patches);
    frame.keypoints.reserve(features.corners.size());
    const bool distorted = camera_.hasDistortion();
    const DepthAt depth_at = depthOf(image, options_);
    for (const Corner& corner : features.corners) {
        Keypoint keypoint{corner.u, corner.v, 0, corner.angle_rad, corner.octave};
        keypoint.depth_m = depth_at(corner.u, corner.v);
        if (distorted) {
            const Eigen::Vector2d pixel = camera_.rectify({corner.u, corner.v});
            keypoint.u = static_cast<float>(pixel.x());
            keypoint.v = static_cast<float>(pixel.y());
        }
        frame.keypoints.push_back(keypoint);
    }
    frame.grid = KeypointGrid(frame.keypoints, camera_.width, camera_.height);
    return frame;
}

}  // namespace rgbd_graphslam
