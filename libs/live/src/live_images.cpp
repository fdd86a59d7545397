/** Images of a frame, reduced to what a window shows. */
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/live/live_messages.h"

namespace rgbd_graphslam {
namespace {

constexpr int widest_picture_px = 320, widest_px = 96;

template <class Pixel>
cv::Mat everyNth(const cv::Mat& image, int step) {
    cv::Mat_<Pixel> small((image.rows + step - 1) / step, (image.cols + step - 1) / step);
    for (int y = 0; y < small.rows; ++y) {
        const Pixel* from = image.ptr<Pixel>(y * step);
        for (Pixel& pixel : cv::Mat_<Pixel>(small.row(y))) {
            pixel = *from;
            from += step;
        }
    }
    return small;
}

cv::Mat reducedColor(const RgbdImage& image, int step) {
    if (!image.color.empty()) return everyNth<cv::Vec3b>(image.color, step);
    cv::Mat color;
    cv::cvtColor(everyNth<uchar>(image.gray, step), color, cv::COLOR_GRAY2BGR);
    return color;
}

}  // namespace

void putImages(const RgbdImage& image, LiveFrame& frame) {
    const int widest = frame.is_picture ? widest_picture_px : widest_px;
    frame.step = std::max(1, (image.depth.cols + widest - 1) / widest);
    frame.depth_unit_m = image.depth_unit_m;
    frame.depth = everyNth<std::uint16_t>(image.depth, frame.step);
    frame.color = reducedColor(image, frame.step);
}

Camera imageCamera(const LiveFrame& frame) {
    if (frame.color.empty() || frame.color.size() != frame.depth.size() || frame.step < 1) {
        throw Error("a live message has no usable images");
    }
    Camera camera = Camera(frame.camera).subsampled(frame.step);
    camera.width = frame.color.cols;
    camera.height = frame.color.rows;
    return camera;
}

}  // namespace rgbd_graphslam
