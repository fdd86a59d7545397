#include "rgbd_graphslam/features/dense_view_builder.h"

#include <cstdint>

#include "rgbd_graphslam/geometry/stereo_depth.h"

namespace rgbd_graphslam {
namespace {

float meanGray(const cv::Mat& gray, int x, int y, int block) {
    int sum = 0;
    for (int j = y; j < y + block; ++j) {
        const auto* row = gray.ptr<std::uint8_t>(j);
        for (int i = x; i < x + block; ++i) sum += row[i];
    }
    return static_cast<float>(sum) / static_cast<float>(block * block);
}

}  // namespace

DenseView DenseViewBuilder::build(const RgbdImage& image) const {
    DenseView view;
    view.camera = blocks_.camera();
    view.gray.resize(blocks_.count());
    for (std::size_t i = 0; i < view.gray.size(); ++i) {
        view.gray[i] = meanGray(image.gray, blocks_.column(i), blocks_.row(i), blocks_.size());
    }
    view.depth_m = blocks_.depthOf(image.depth.empty() ? withDenseDepth(image) : image);
    return view;
}

}  // namespace rgbd_graphslam
