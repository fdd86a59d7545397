#include "rgbd_graphslam/mapping/packed_images.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

std::vector<unsigned char> packed(const cv::Mat& image) {
    constexpr int fast = 1;  // zlib's level: a tenth larger than the default, four times as fast
    std::vector<unsigned char> bytes;
    cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, fast});
    return bytes;
}

}  // namespace

void PackedImages::add(const RgbdImage& image) {
    packed_[image.stamp_s] = {image.depth_unit_m,
                              packed(image.color.empty() ? image.gray : image.color),
                              packed(image.depth)};
}

RgbdImage PackedImages::unpacked(double stamp_s, const Packed& packed) {
    RgbdImage image;
    image.stamp_s = stamp_s;
    image.depth_unit_m = packed.depth_unit_m;
    image.color = cv::imdecode(packed.color, cv::IMREAD_COLOR);
    cv::cvtColor(image.color, image.gray, cv::COLOR_BGR2GRAY);
    image.depth = cv::imdecode(packed.depth, cv::IMREAD_UNCHANGED);
    return image;
}

std::size_t PackedImages::forEach(const Trajectory& keyframes, const std::string&,
                                  const Consume& consume, const Note&) const {
    std::size_t passed = 0;
    for (std::size_t k = 0; k < keyframes.size(); ++k) {
        const StampedPose& pose = keyframes[k];
        const auto found = packed_.find(pose.stamp_s);
        if (found == packed_.end()) continue;
        consume({k, pose, pose.stamp_s, unpacked(pose.stamp_s, found->second), camera_, SE3()});
        ++passed;
    }
    if (passed == 0) throw Error("there are no images of any keyframe", "track frames first");
    return passed;
}

}  // namespace rgbd_graphslam
