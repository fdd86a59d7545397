#include "rgbd_graphslam/dataset/stereo_frame.h"

#include <cmath>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "number_text.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/geometry/stereo_depth.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservationStereoImages;
namespace {

[[noreturn]] void refuse(const CObservationStereoImages& pair, const std::string& why) {
    throw Error("stereo pair at stamp " + stampText(toSeconds(pair.timestamp)) + ": " + why,
                "import the sequence again with rgbd-import, or leave this sensor out");
}

bool isUsable(const Intrinsics& camera) {
    constexpr int largest_image_px = 1 << 14;
    const bool has_size = camera.width > 0 && camera.height > 0 &&
                          camera.width < largest_image_px && camera.height < largest_image_px;
    return has_size && camera.fx > 0 && camera.fy > 0 && std::isfinite(camera.fx * camera.fy) &&
           std::isfinite(camera.cx + camera.cy) && CameraModel(camera).isInvertible();
}

SE3 poseOf(const mrpt::poses::CPose3DQuat& pose) {
    return toSE3(mrpt::poses::CPose3D(pose));
}

/** A calibration and what rectifies its images: the same for all of a recording, slow to make. */
struct Rectification {
    Intrinsics left, right;
    SE3 T_left_right;
    std::shared_ptr<const StereoRectifier> rectifier;

    bool serves(const Rectification& other) const {
        return left == other.left && right == other.right &&
               T_left_right.R == other.T_left_right.R && T_left_right.t == other.T_left_right.t;
    }
};

void say(const Intrinsics& camera, double baseline_m) {
    sayInfo(formatted("stereo: %dx%d pixels rectified, f = %.5g px, baseline %.4g m", camera.width,
                      camera.height, camera.fx, baseline_m));
}

std::shared_ptr<const StereoRectifier> rectifierFor(const CObservationStereoImages& pair) {
    constexpr std::size_t most_cameras = 8;
    static std::mutex mutex;
    static std::vector<Rectification> known;
    Rectification wanted{toCamera(pair.leftCamera), toCamera(pair.rightCamera),
                         poseOf(pair.rightCameraPose), nullptr};
    const std::lock_guard lock(mutex);
    for (const Rectification& one : known) {
        if (one.serves(wanted)) return one.rectifier;
    }
    if (!isUsable(wanted.left) || !isUsable(wanted.right)) {
        refuse(pair, "its calibration is unusable");
    }
    wanted.rectifier =
        std::make_shared<const StereoRectifier>(wanted.left, wanted.right, wanted.T_left_right);
    say(wanted.rectifier->camera(), wanted.T_left_right.t.norm());
    if (known.size() == most_cameras) known.erase(known.begin());
    known.push_back(std::move(wanted));
    return known.back().rectifier;
}

cv::Mat pixelsOf(const CObservationStereoImages& pair, const mrpt::img::CImage& image,
                 const mrpt::img::TCamera& camera, const char* side) {
    cv::Mat pixels;
    try {
        image.forceLoad();
        pixels = image.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    } catch (const std::exception&) {
        pixels = cv::Mat();
    }
    if (pixels.empty()) refuse(pair, std::string("its ") + side + " image cannot be read");
    const cv::Size size(static_cast<int>(camera.ncols), static_cast<int>(camera.nrows));
    if (pixels.depth() != CV_8U || pixels.size() != size) {
        refuse(pair, std::string("its ") + side + " image does not fit its calibration");
    }
    return pixels;
}

cv::Mat grayOf(const cv::Mat& pixels) {
    if (pixels.channels() == 1) return pixels;
    cv::Mat gray;
    cv::cvtColor(pixels, gray, pixels.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
    return gray;
}

}  // namespace

StereoFrame::StereoFrame(CObservationStereoImages::Ptr pair)
    : pair_(std::move(pair)), rectifier_(rectifierFor(*pair_)) {
    if (!pair_->hasImageRight) refuse(*pair_, "no right image");
    timestamp = pair_->timestamp;
    sensorLabel = pair_->sensorLabel;
    sensorPose =
        toCPose3D(poseOf(pair_->cameraPose) * rectifier_->T_left_rectified() * T_optical_from_mrpt);
    relativePoseIntensityWRTDepth = toCPose3D(T_optical_from_mrpt.inverse());
    cameraParams = cameraParamsIntensity = toTCamera(rectifier_->camera());
    rangeUnits = static_cast<float>(stereoDepthUnit(disparityInMeterPixels()));
    hasIntensityImage = hasRangeImage = range_is_depth = true;
}

RgbdImage StereoFrame::images() const {
    RgbdImage image;
    image.stamp_s = toSeconds(timestamp);
    image.disparity_m_px = disparityInMeterPixels();
    image.owner = pair_;
    const cv::Mat left =
        rectifier_->left(pixelsOf(*pair_, pair_->imageLeft, pair_->leftCamera, "left"));
    image.gray = grayOf(left);
    if (left.channels() == 3) image.color = left;
    image.right =
        rectifier_->right(grayOf(pixelsOf(*pair_, pair_->imageRight, pair_->rightCamera, "right")));
    return image;
}

mrpt::obs::CObservation3DRangeScan::Ptr asRgbdFrame(
    const mrpt::obs::CObservation::Ptr& observation) {
    if (auto pair = std::dynamic_pointer_cast<CObservationStereoImages>(observation)) {
        return std::make_shared<StereoFrame>(std::move(pair));
    }
    return std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation);
}

}  // namespace rgbd_graphslam
