#include "rgbd_graphslam/dataset/rgbd_observation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <opencv2/imgproc.hpp>

#include "number_text.h"
#include "reading_guards.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/depth_registration.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/stereo_frame.h"
#include "rgbd_graphslam/geometry/stereo_depth.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation3DRangeScan;
namespace {

/** What viewers scale depth by; readings beyond stay readings. */
constexpr float max_range_m = 10;

[[noreturn]] void refuse(const CObservation3DRangeScan& observation, const std::string& why) {
    throw Error("frame at stamp " + stampText(toSeconds(observation.timestamp)) + ": " + why,
                "import the sequence again with rgbd-import, or leave this sensor out");
}

/** MRPT copies the byte of a file into a bool; other than 0 and 1 must not be looked at as one. */
bool isFlag(const bool& flag) {
    unsigned char byte = 0;
    std::memcpy(&byte, &flag, 1);
    return byte <= 1;
}

void checkContents(const CObservation3DRangeScan& observation) {
    if (!isFlag(observation.hasIntensityImage) || !isFlag(observation.hasConfidenceImage) ||
        !isFlag(observation.hasRangeImage) || !isFlag(observation.range_is_depth)) {
        refuse(observation, "damaged: a flag is neither yes nor no");
    }
    if (!observation.hasIntensityImage) refuse(observation, "no color image");
    if (!observation.hasRangeImage) refuse(observation, "no depth image");
    if (!observation.range_is_depth) refuse(observation, "ranges along rays instead of depth");
}

bool allFinite(const SE3& pose) {
    return pose.R.allFinite() && pose.t.allFinite();
}

/** What a wrong number would spoil without a word. */
void checkNumbers(const CObservation3DRangeScan& observation) {
    cameraOf(observation);
    if (!(observation.rangeUnits > 0) || !std::isfinite(observation.rangeUnits)) {
        refuse(observation, "its depth unit is not positive");
    }
    if (!allFinite(cameraOnRobot(observation))) {
        refuse(observation, "its sensor pose is not finite");
    }
}

void loadExternals(const CObservation3DRangeScan& observation) {
    constexpr std::size_t most_bytes_of_block = std::size_t{1} << 30;
    const MemoryLimit limit(most_bytes_of_block);
    try {
        observation.load();
        observation.intensityImage.forceLoad();
        if (observation.hasConfidenceImage) observation.confidenceImage.forceLoad();
    } catch (const std::exception&) {
        const auto& image = observation.intensityImage;
        refuse(observation, "an image stored outside the rawlog cannot be read" +
                                (image.isExternallyStored()
                                     ? " ('" + image.getExternalStorageFileAbsolutePath() + "')"
                                     : std::string()));
    }
}

cv::Mat sharedDepth(const CObservation3DRangeScan& observation) {
    const auto& ranges = observation.rangeImage;
    return cv::Mat(static_cast<int>(ranges.rows()), static_cast<int>(ranges.cols()), CV_16UC1,
                   const_cast<std::uint16_t*>(ranges.data()));
}

/** The formats that images stored outside a rawlog may have, as 8-bit BGR or gray. */
cv::Mat asColorOrGray(const CObservation3DRangeScan& observation, cv::Mat pixels) {
    if (pixels.depth() == CV_16U) pixels.convertTo(pixels, CV_8U, 1 / 256.0);
    if (pixels.depth() != CV_8U) refuse(observation, "its color image is of an unknown kind");
    if (pixels.channels() == 4) cv::cvtColor(pixels, pixels, cv::COLOR_BGRA2BGR);
    return pixels;
}

cv::Size depthSize(const CObservation3DRangeScan& observation) {
    return {static_cast<int>(observation.rangeImage.cols()),
            static_cast<int>(observation.rangeImage.rows())};
}

/** Empty while it is not known: images outside the rawlog may not be loaded yet. */
cv::Size colorSize(const CObservation3DRangeScan& observation) {
    const auto& image = observation.intensityImage;
    if (!observation.hasIntensityImage || image.isExternallyStored() || image.isEmpty()) {
        return depthSize(observation);
    }
    return {static_cast<int>(image.getWidth()), static_cast<int>(image.getHeight())};
}

void sayResized(const Intrinsics& camera, const Intrinsics& resized) {
    static std::once_flag said;
    std::call_once(said, [&] {
        char text[240];
        std::snprintf(text, sizeof text,
                      "the rawlog's calibration is for %dx%d pixels, its images have %dx%d: taken "
                      "as resized (fx = %.6g, fy = %.6g, cx = %.6g, cy = %.6g)",
                      camera.width, camera.height, resized.width, resized.height, resized.fx,
                      resized.fy, resized.cx, resized.cy);
        sayWarning(text);
    });
}

/** A calibration for images of this size, if one for another size can be made to fit. */
Intrinsics fitted(const mrpt::img::TCamera& calibration, cv::Size size) {
    const Intrinsics camera = toCamera(calibration);
    const bool unknown = size.area() == 0 || camera.width == 0 || camera.height == 0;
    if (unknown || size == cv::Size(camera.width, camera.height)) return camera;
    const auto resized = resizedTo(camera, size.width, size.height);
    if (!resized) return camera;
    sayResized(camera, *resized);
    return *resized;
}

SE3 colorFromDepth(const CObservation3DRangeScan& observation) {
    return toSE3(observation.relativePoseIntensityWRTDepth).inverse() *
           T_optical_from_mrpt.inverse();
}

bool isIdentity(const SE3& T) {
    return T.t.norm() < 1e-5 && (T.R - Eigen::Matrix3d::Identity()).norm() < 1e-5;
}

/** What registers depth of an observation: the same for all of a recording, and slow to make. */
struct Registrar {
    Intrinsics depth, color;
    SE3 T_color_depth;
    double unit_m = 0;
    std::shared_ptr<const DepthRegistration> registration;

    bool serves(const Registrar& other) const {
        return depth == other.depth && color == other.color && unit_m == other.unit_m &&
               T_color_depth.R == other.T_color_depth.R && T_color_depth.t == other.T_color_depth.t;
    }
};

std::shared_ptr<const DepthRegistration> registrationBy(Registrar wanted) {
    static std::mutex mutex;
    static Registrar last;
    const std::lock_guard lock(mutex);
    if (!last.registration || !last.serves(wanted)) {
        wanted.registration = std::make_shared<DepthRegistration>(
            wanted.depth, wanted.color, wanted.T_color_depth, wanted.unit_m);
        last = std::move(wanted);
        static std::once_flag said;
        std::call_once(said, [] {
            sayInfo("the rawlog's depth is of a camera of its own: registered to color");
        });
    }
    return last.registration;
}

/** \throws Error when the two cameras cannot lie so */
void checkDepthCamera(const CObservation3DRangeScan& observation, const Registrar& cameras) {
    constexpr double farthest_apart_m = 0.5, widest_turn = 0.7;  // rad
    const Intrinsics& depth = cameras.depth;
    if (!(depth.fx > 0 && depth.fy > 0) || !std::isfinite(depth.fx * depth.fy) ||
        !std::isfinite(depth.cx + depth.cy) || !CameraModel(depth).isInvertible()) {
        refuse(observation, "depth is of another camera, whose calibration is unusable");
    }
    const SE3& T = cameras.T_color_depth;
    const double turn = std::acos(std::clamp((T.R.trace() - 1) / 2, -1.0, 1.0));
    if (!(T.t.norm() < farthest_apart_m) || !(turn < widest_turn)) {
        refuse(observation,
               "depth is of another camera, whose pose beside the color camera is implausible");
    }
}

/** Depth as the color camera would see it; the very same where one camera took both. */
cv::Mat registeredDepth(const CObservation3DRangeScan& observation, const cv::Mat& depth,
                        cv::Size color_size) {
    Registrar cameras;
    cameras.color = fitted(observation.cameraParamsIntensity, color_size);
    cameras.depth = fitted(observation.cameraParams, depth.size());
    cameras.T_color_depth = colorFromDepth(observation);
    cameras.unit_m = observation.rangeUnits;
    if (cameras.depth == cameras.color && isIdentity(cameras.T_color_depth)) return depth;
    if (cameras.color.width == 0) {
        cameras.color.width = color_size.width;
        cameras.color.height = color_size.height;
    }
    const cv::Size stated(cameras.color.width, cameras.color.height);
    if (stated != color_size) return depth;  // who uses it refuses such a calibration
    cameras.depth.width = depth.cols;
    cameras.depth.height = depth.rows;
    checkDepthCamera(observation, cameras);
    return (*registrationBy(std::move(cameras)))(depth);
}

/** Pixels without confidence are left out. An image of another size is of a depth camera of its
 *  own, and speaks of that. */
cv::Mat maskOf(const CObservation3DRangeScan& observation, cv::Size size) {
    if (!observation.hasConfidenceImage) return {};
    const cv::Mat confidence =
        observation.confidenceImage.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    if (confidence.size() != size || confidence.type() != CV_8UC1) return {};
    return confidence;
}

}  // namespace

RgbdImage colorAndDepth(const CObservation3DRangeScan::Ptr& observation) {
    if (const auto* stereo = dynamic_cast<const StereoFrame*>(observation.get())) {
        return withDenseDepth(stereo->images());
    }
    checkContents(*observation);
    checkNumbers(*observation);
    loadExternals(*observation);
    RgbdImage image;
    image.stamp_s = toSeconds(observation->timestamp);
    image.depth_unit_m = observation->rangeUnits;
    image.depth = sharedDepth(*observation);
    image.owner = observation;
    const cv::Mat pixels = asColorOrGray(
        *observation, observation->intensityImage.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY));
    image.depth = registeredDepth(*observation, image.depth, pixels.size());
    if (pixels.size() != image.depth.size()) {
        refuse(*observation, "color and depth differ in size");
    }
    (pixels.channels() == 1 ? image.gray : image.color) = pixels;
    image.mask = maskOf(*observation, pixels.size());
    return image;
}

RgbdImage toRgbdImage(const CObservation3DRangeScan::Ptr& observation) {
    RgbdImage image = colorAndDepth(observation);
    if (image.gray.empty()) cv::cvtColor(image.color, image.gray, cv::COLOR_BGR2GRAY);
    if (!image.mask.empty()) {
        cv::Mat depth(image.depth.size(), image.depth.type(), cv::Scalar(0));
        image.depth.copyTo(depth, image.mask);
        image.depth = depth;
    }
    return image;
}

RgbdImage toTrackingImage(const CObservation3DRangeScan::Ptr& observation) {
    const auto* stereo = dynamic_cast<const StereoFrame*>(observation.get());
    return stereo ? stereo->images() : toRgbdImage(observation);
}

Intrinsics cameraOf(const CObservation3DRangeScan& observation) {
    constexpr int largest_image_px = 1 << 16;
    const Intrinsics stated = toCamera(observation.cameraParamsIntensity);
    const bool has_focus = stated.fx > 0 && stated.fy > 0 && std::isfinite(stated.fx * stated.fy);
    if (!has_focus || !std::isfinite(stated.cx + stated.cy)) {
        refuse(observation, "its calibration has no usable fx, fy, cx, cy");
    }
    for (const int side : {stated.width, stated.height}) {
        if (side < 0 || side > largest_image_px) {
            refuse(observation, "its calibration is for images of an impossible size");
        }
    }
    const Intrinsics camera = fitted(observation.cameraParamsIntensity, colorSize(observation));
    if (!CameraModel(camera).isInvertible()) {
        refuse(observation, "its calibration has a lens distortion that cannot be undone");
    }
    return camera;
}

SE3 cameraOnRobot(const CObservation3DRangeScan& observation) {
    return toSE3(observation.sensorPose) * toSE3(observation.relativePoseIntensityWRTDepth);
}

RigCamera rigCameraOf(const CObservation3DRangeScan& observation) {
    const auto* stereo = dynamic_cast<const StereoFrame*>(&observation);
    return {observation.sensorLabel, cameraOf(observation), cameraOnRobot(observation),
            stereo ? stereo->disparityInMeterPixels() : 0};
}

CObservation3DRangeScan::Ptr makeRgbdObservation(const CameraSetup& setup, double stamp_s) {
    auto observation = CObservation3DRangeScan::Create();
    observation->sensorLabel = rgbd_label;
    observation->timestamp = toMrptTime(stamp_s);
    observation->sensorPose = toCPose3D(setup.T_base_sensor);
    observation->relativePoseIntensityWRTDepth = toCPose3D(T_optical_from_mrpt.inverse());
    observation->cameraParams = toTCamera(setup.camera);
    observation->cameraParamsIntensity = observation->cameraParams;
    observation->rangeUnits = static_cast<float>(setup.depthUnitInMetres());
    observation->maxRange = max_range_m;
    return observation;
}

CObservation3DRangeScan::Ptr makeRgbdObservation(const CameraSetup& setup, double stamp_s,
                                                 const cv::Mat& color, const cv::Mat& depth) {
    auto observation = makeRgbdObservation(setup, stamp_s);
    setColor(*observation, color);
    setDepth(*observation, depth);
    return observation;
}

void setDepth(CObservation3DRangeScan& observation, const cv::Mat& depth) {
    observation.hasRangeImage = true;
    observation.rangeImage_setSize(depth.rows, depth.cols);
    depth.copyTo(sharedDepth(observation));
}

void setMask(CObservation3DRangeScan& observation, const cv::Mat& mask) {
    observation.hasConfidenceImage = true;
    observation.confidenceImage = mrpt::img::CImage(mask, mrpt::img::DEEP_COPY);
}

void setColor(CObservation3DRangeScan& observation, const cv::Mat& color) {
    observation.hasIntensityImage = true;
    observation.intensityImage = mrpt::img::CImage(color, mrpt::img::SHALLOW_COPY);
}

}  // namespace rgbd_graphslam
