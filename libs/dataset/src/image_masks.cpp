#include "image_masks.h"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/image_file.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

const char* const remedy = "a mask is an 8-bit image, black where the image is to be ignored";

cv::Mat readMask(const std::string& path) {
    const DecodedImage image = readColorImage(path);
    if (!image.damage.empty()) throw Error("mask " + image.damage, remedy);
    cv::Mat mask;
    cv::cvtColor(image.pixels, mask, cv::COLOR_BGR2GRAY);
    return mask > 127;
}

void checkSize(const cv::Mat& mask, const cv::Size& size, const std::string& path) {
    if (mask.size() == size) return;
    throw Error("the mask '" + path + "' has " + std::to_string(mask.cols) + "x" +
                    std::to_string(mask.rows) + " pixels, the color images " +
                    std::to_string(size.width) + "x" + std::to_string(size.height),
                "give it the size of the color images");
}

}  // namespace

ImageMasks::ImageMasks(const std::string& folder, const std::string& file) : file_(file) {
    const fs::path beside = fs::path(folder) / "mask.png", per_frame = fs::path(folder) / "mask";
    if (file_.empty() && fs::exists(beside)) file_ = beside;
    if (!file_.empty()) whole_ = readMask(file_);
    if (fs::is_directory(per_frame)) folder_ = per_frame;
}

cv::Mat ImageMasks::of(const std::string& color_file, const cv::Size& size) const {
    cv::Mat mask = whole_;
    if (!mask.empty()) checkSize(mask, size, file_);
    const fs::path own =
        fs::path(folder_) / fs::path(color_file).filename().replace_extension(".png");
    if (!folder_.empty() && fs::exists(own)) {
        const cv::Mat of_frame = readMask(own);
        checkSize(of_frame, size, own);
        mask = mask.empty() ? of_frame : cv::Mat(mask & of_frame);
    }
    const bool leaves_out = !mask.empty() && cv::countNonZero(mask) < mask.size().area();
    return leaves_out ? mask : cv::Mat();
}

}  // namespace rgbd_graphslam
