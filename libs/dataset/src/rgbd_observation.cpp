#include "rgbd_graphslam/dataset/rgbd_observation.h"

#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "number_text.h"
#include "reading_guards.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"

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
    if (!isFlag(observation.hasIntensityImage) || !isFlag(observation.hasRangeImage) ||
        !isFlag(observation.range_is_depth)) {
        refuse(observation, "damaged: a flag is neither yes nor no");
    }
    if (!observation.hasIntensityImage) refuse(observation, "no colour image");
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

/** The formats that images stored outside a rawlog may have, as 8-bit BGR or grey. */
cv::Mat asColorOrGrey(const CObservation3DRangeScan& observation, cv::Mat pixels) {
    if (pixels.depth() == CV_16U) pixels.convertTo(pixels, CV_8U, 1 / 256.0);
    if (pixels.depth() != CV_8U) refuse(observation, "its colour image is of an unknown kind");
    if (pixels.channels() == 4) cv::cvtColor(pixels, pixels, cv::COLOR_BGRA2BGR);
    return pixels;
}

}  // namespace

RgbdImage colorAndDepth(const CObservation3DRangeScan::Ptr& observation) {
    checkContents(*observation);
    checkNumbers(*observation);
    loadExternals(*observation);
    RgbdImage image;
    image.stamp_s = toSeconds(observation->timestamp);
    image.depth_unit_m = observation->rangeUnits;
    image.depth = sharedDepth(*observation);
    image.owner = observation;
    const cv::Mat pixels = asColorOrGrey(
        *observation, observation->intensityImage.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY));
    if (pixels.size() != image.depth.size()) {
        refuse(*observation, "colour and depth differ in size");
    }
    (pixels.channels() == 1 ? image.grey : image.color) = pixels;
    return image;
}

RgbdImage toRgbdImage(const CObservation3DRangeScan::Ptr& observation) {
    RgbdImage image = colorAndDepth(observation);
    if (image.grey.empty()) cv::cvtColor(image.color, image.grey, cv::COLOR_BGR2GRAY);
    return image;
}

Camera cameraOf(const CObservation3DRangeScan& observation) {
    constexpr int largest_image_px = 1 << 16;
    const Camera camera = toCamera(observation.cameraParamsIntensity);
    const bool has_focus = camera.fx > 0 && camera.fy > 0 && std::isfinite(camera.fx * camera.fy);
    if (!has_focus || !std::isfinite(camera.cx + camera.cy)) {
        refuse(observation, "its calibration has no usable fx, fy, cx, cy");
    }
    for (const int side : {camera.width, camera.height}) {
        if (side < 0 || side > largest_image_px) {
            refuse(observation, "its calibration is for images of an impossible size");
        }
    }
    if (!camera.undoesDistortion()) {
        refuse(observation, "its calibration has a lens distortion that cannot be undone");
    }
    return camera;
}

SE3 cameraOnRobot(const CObservation3DRangeScan& observation) {
    return toSE3(observation.sensorPose) * toSE3(observation.relativePoseIntensityWRTDepth);
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

void setDepth(CObservation3DRangeScan& observation, const cv::Mat& depth) {
    observation.hasRangeImage = true;
    observation.rangeImage_setSize(depth.rows, depth.cols);
    depth.copyTo(sharedDepth(observation));
}

void setColor(CObservation3DRangeScan& observation, const cv::Mat& color) {
    observation.hasIntensityImage = true;
    observation.intensityImage = mrpt::img::CImage(color, mrpt::img::SHALLOW_COPY);
}

}  // namespace rgbd_graphslam
