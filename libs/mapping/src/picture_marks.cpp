#include "rgbd_graphslam/mapping/picture_marks.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

constexpr int margin_px = 16, most_bar_px = 160, end_px = 4;
constexpr double font_size = 0.45;

void write(cv::Mat3b& picture, const std::string& text, const cv::Point& corner) {
    const auto put = [&](const Rgba& color, int thickness) {
        cv::putText(picture, text, corner, cv::FONT_HERSHEY_SIMPLEX, font_size, bgrOf(color),
                    thickness, cv::LINE_AA);
    };
    put(background_color, 3);  // a rim: labels may lie on the map
    put(label_color, 1);
}

cv::Size sizeOf(const std::string& text) {
    int baseline = 0;
    return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, font_size, 1, &baseline);
}

}  // namespace

cv::Scalar bgrOf(const Rgba& color) {
    return {double(color[2]), double(color[1]), double(color[0])};
}

void drawScaleBar(cv::Mat3b& picture, double m_per_px) {
    const ScaleBar bar = scaleBar(m_per_px, std::min(most_bar_px, picture.cols / 3));
    const int length = static_cast<int>(std::lround(bar.length_px));
    const cv::Point left(margin_px, picture.rows - margin_px), right = left + cv::Point(length, 0);
    const cv::Scalar color = bgrOf(label_color);
    cv::line(picture, left, right, color, 2);
    for (const cv::Point& end : {left, right})
        cv::line(picture, end - cv::Point(0, end_px), end + cv::Point(0, end_px), color, 2);
    const std::string text = lengthText(bar.length_m);
    write(picture, text, left + cv::Point((length - sizeOf(text).width) / 2, -8));
}

void drawLabels(cv::Mat3b& picture, const std::vector<SceneLabel>& labels) {
    for (const SceneLabel& label : labels) {
        const cv::Size size = sizeOf(label.text);
        const cv::Point middle(static_cast<int>(label.pixel.x()),
                               static_cast<int>(label.pixel.y()));
        write(picture, label.text, middle + cv::Point(-size.width / 2, size.height / 2));
    }
}

}  // namespace rgbd_graphslam
