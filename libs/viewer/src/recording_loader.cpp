#include "rgbd_graphslam/viewer/recording_loader.h"

#include <opencv2/imgcodecs.hpp>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/viewer/keyframe_view.h"

namespace rgbd_graphslam {
namespace {

constexpr int picture_width_px = 320;

struct Stopped {};

std::vector<unsigned char> jpegOf(const cv::Mat& image) {
    std::vector<unsigned char> bytes;
    cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 85});
    return bytes;
}

KeyframePicture pictureOf(const Keyframe3D& keyframe) {
    const RgbdImage& image = keyframe.image;
    KeyframePicture picture;
    picture.keyframe = keyframe.index;
    picture.color_jpeg = jpegOf(thinned(image.color, picture_width_px));
    picture.depth_jpeg =
        jpegOf(paintedDepth(thinned(image.depth, picture_width_px), image.depth_unit_m));
    picture.points =
        transformed(keyframe.pose.T_world_cam,
                    keyframePoints(image.color, image.depth, image.depth_unit_m, keyframe.camera));
    return picture;
}

}  // namespace

RecordingLoader::RecordingLoader(std::unique_ptr<const KeyframeImages> images, Trajectory keyframes)
    : images_(std::move(images)), keyframes_(std::move(keyframes)), thread_([this] { read(); }) {}

RecordingLoader::~RecordingLoader() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    thread_.join();
}

RecordingLoader::News RecordingLoader::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, News{{}, {}, news_.finished});
}

void RecordingLoader::read() {
    try {
        readPictures();
    } catch (const Stopped&) {
        return;
    } catch (const std::exception& e) {
        sayWarning(std::string("not all images of the recording are shown: ") + e.what());
    }
    const std::lock_guard lock(mutex_);
    news_.finished = true;
}

void RecordingLoader::readPictures() {
    images_->forEach(keyframes_, "images", [&](const Keyframe3D& keyframe) {
        KeyframePicture picture = pictureOf(keyframe);
        const std::lock_guard lock(mutex_);
        if (stop_) throw Stopped();
        news_.pictures.push_back(std::move(picture));
        news_.camera = keyframe.camera;
    });
}

}  // namespace rgbd_graphslam
