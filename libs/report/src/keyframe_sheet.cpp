#include "rgbd_graphslam/report/keyframe_sheet.h"

#include <algorithm>
#include <cstdio>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

constexpr std::size_t most = 48, columns = 8;
constexpr int width_px = 160;

cv::Mat3b reduced(const cv::Mat& picture) {
    const int height_px = std::max(1, picture.rows * width_px / std::max(1, picture.cols));
    cv::Mat image;
    cv::resize(picture, image, {width_px, height_px}, 0, 0, cv::INTER_AREA);
    if (image.channels() == 1) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
    return image;
}

/** Light letters with a dark rim can be read on any picture. */
void label(cv::Mat& image, int keyframe, double seconds) {
    char text[48];
    std::snprintf(text, sizeof(text), "%d: %.1f s", keyframe, seconds);
    const cv::Point corner(5, image.rows - 6);
    const auto write = [&](const cv::Scalar& color, int thickness) {
        cv::putText(image, text, corner, cv::FONT_HERSHEY_SIMPLEX, 0.4, color, thickness,
                    cv::LINE_AA);
    };
    write(cv::Scalar::all(0), 3);
    write(cv::Scalar::all(255), 1);
}

}  // namespace

void KeyframeSheet::add(int keyframe, double seconds, const cv::Mat& picture) {
    if (count_++ % stride_ != 0) return;
    thumbnails_.push_back({keyframe, seconds, reduced(picture)});
    if (thumbnails_.size() > most) thinOut();
}

void KeyframeSheet::thinOut() {
    std::vector<Thumbnail> kept;
    for (std::size_t i = 0; i < thumbnails_.size(); i += 2) kept.push_back(thumbnails_[i]);
    thumbnails_ = std::move(kept);
    stride_ *= 2;
}

cv::Mat3b KeyframeSheet::picture() const {
    if (thumbnails_.empty()) return {};
    const cv::Size size = thumbnails_.front().image.size();
    const int across = static_cast<int>(std::min(columns, thumbnails_.size()));
    const int down = static_cast<int>((thumbnails_.size() + columns - 1) / columns);
    cv::Mat3b sheet(down * size.height, across * size.width, cv::Vec3b(255, 255, 255));
    for (std::size_t i = 0; i < thumbnails_.size(); ++i) {
        const cv::Point corner(static_cast<int>(i % columns) * size.width,
                               static_cast<int>(i / columns) * size.height);
        cv::Mat place = sheet(cv::Rect(corner, size));
        cv::resize(thumbnails_[i].image, place, size);
        label(place, thumbnails_[i].keyframe, thumbnails_[i].seconds);
    }
    return sheet;
}

}  // namespace rgbd_graphslam
