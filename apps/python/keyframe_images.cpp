#include "keyframe_images.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

std::vector<unsigned char> packed(const cv::Mat& image) {
    constexpr int fast = 1;  // zlib's level: a tenth larger than the default, four times as fast
    std::vector<unsigned char> bytes;
    cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, fast});
    return bytes;
}

}  // namespace

void KeyframeImages::add(int keyframe, const RgbdImage& image) {
    packed_[keyframe] = {image.stamp_s, image.depth_unit_m,
                         packed(image.color.empty() ? image.gray : image.color),
                         packed(image.depth)};
}

RgbdImage KeyframeImages::operator[](int keyframe) const {
    const Packed& kept = packed_.at(keyframe);
    RgbdImage image;
    image.stamp_s = kept.stamp_s;
    image.depth_unit_m = kept.depth_unit_m;
    image.color = cv::imdecode(kept.color, cv::IMREAD_COLOR);
    cv::cvtColor(image.color, image.gray, cv::COLOR_BGR2GRAY);
    image.depth = cv::imdecode(kept.depth, cv::IMREAD_UNCHANGED);
    return image;
}

}  // namespace rgbd_graphslam
