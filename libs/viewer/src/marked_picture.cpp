#include "rgbd_graphslam/viewer/marked_picture.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

constexpr int mark_px = 3;

cv::Vec4b pixelOf(const Rgba& color) {
    return {color[0], color[1], color[2], color[3]};
}

void paintMark(cv::Mat4b& picture, const PictureMark& mark) {
    const int x = static_cast<int>(mark.x * static_cast<float>(picture.cols)) - mark_px / 2;
    const int y = static_cast<int>(mark.y * static_cast<float>(picture.rows)) - mark_px / 2;
    const cv::Rect square(x, y, mark_px, mark_px);
    picture(square & cv::Rect({}, picture.size())) = pixelOf(mark.color);
}

}  // namespace

cv::Mat4b fittedPicture(const cv::Mat3b& image, const std::vector<PictureMark>& marks,
                        const cv::Size& size_px, const Rgba& margin) {
    const double scale = std::min(static_cast<double>(size_px.width) / image.cols,
                                  static_cast<double>(size_px.height) / image.rows);
    const cv::Size fitted(std::clamp(cvRound(scale * image.cols), 1, size_px.width),
                          std::clamp(cvRound(scale * image.rows), 1, size_px.height));
    cv::Mat resized;
    cv::resize(image, resized, fitted, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
    cv::Mat4b canvas(size_px, pixelOf(margin));
    cv::Mat4b picture = canvas(cv::Rect((size_px - fitted) / 2, fitted));
    cv::cvtColor(resized, picture, cv::COLOR_BGR2RGBA);
    for (const PictureMark& mark : marks) paintMark(picture, mark);
    return canvas;
}

}  // namespace rgbd_graphslam
