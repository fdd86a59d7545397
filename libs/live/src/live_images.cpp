/** Images of a frame, reduced to what a window shows. */
#include <algorithm>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/live/live_messages.h"

namespace rgbd_graphslam {
namespace {

constexpr int widest_px = 320, jpeg_quality = 80;

cv::Mat everyNth(const cv::Mat& image, int step) {
    cv::Mat small((image.rows + step - 1) / step, (image.cols + step - 1) / step, image.type());
    for (int y = 0; y < small.rows; ++y) {
        for (int x = 0; x < small.cols; ++x) {
            std::memcpy(small.ptr(y, x), image.ptr(y * step, x * step), image.elemSize());
        }
    }
    return small;
}

/** Of the images whose pixels are every n-th of the camera's. */
Camera reduced(Camera camera, const cv::Size& size, int step) {
    camera.width = size.width;
    camera.height = size.height;
    for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value /= step;
    return camera;
}

}  // namespace

void putImages(const RgbdImage& image, LiveFrame& frame) {
    frame.depth_step = std::max(1, (image.depth.cols + widest_px - 1) / widest_px);
    frame.depth_unit_m = image.depth_unit_m;
    frame.depth = everyNth(image.depth, frame.depth_step);
    cv::imencode(".jpg", everyNth(image.color, frame.depth_step), frame.color_jpeg,
                 {cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
}

LiveImages imagesOf(const LiveFrame& frame) {
    LiveImages images;
    if (!frame.color_jpeg.empty()) {
        images.color = cv::imdecode(frame.color_jpeg, cv::IMREAD_COLOR);
    }
    images.depth = frame.depth;
    if (images.color.empty() || images.color.size() != images.depth.size() ||
        frame.depth_step < 1) {
        throw Error("a live message has no usable images");
    }
    images.camera = reduced(frame.camera, images.depth.size(), frame.depth_step);
    return images;
}

}  // namespace rgbd_graphslam
