#include "rgbd_graphslam/dataset/image_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using Bytes = std::vector<unsigned char>;

const Bytes png_start = {0x89, 'P', 'N', 'G'},
            png_end = {'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
const Bytes jpeg_start = {0xff, 0xd8}, jpeg_end = {0xff, 0xd9};
const Bytes exr_start = {0x76, 0x2f, 0x31, 0x01};

Bytes bytesOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    Bytes bytes(in ? static_cast<std::size_t>(in.tellg()) : 0);
    in.seekg(0);
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return bytes;
}

bool startsWith(const Bytes& bytes, const Bytes& mark) {
    return bytes.size() >= mark.size() && std::equal(mark.begin(), mark.end(), bytes.begin());
}

/** Cameras pad files, hence not only at the very end. */
bool endsNearly(const Bytes& bytes, const Bytes& mark) {
    const std::size_t tail = std::min<std::size_t>(bytes.size(), 4096);
    return std::search(bytes.end() - static_cast<std::ptrdiff_t>(tail), bytes.end(), mark.begin(),
                       mark.end()) != bytes.end();
}

/** The decoders fill what a cut file lacks with grey and call it a success. */
bool cutOff(const Bytes& bytes) {
    return (startsWith(bytes, png_start) && !endsNearly(bytes, png_end)) ||
           (startsWith(bytes, jpeg_start) && !endsNearly(bytes, jpeg_end));
}

DecodedImage decoded(const std::string& path, const Bytes& bytes, int flags) {
    if (bytes.empty()) return {{}, "'" + path + "' is empty or unreadable"};
    if (cutOff(bytes)) return {{}, "'" + path + "' is cut off"};
    DecodedImage image;
    try {
        image.pixels = cv::imdecode(bytes, flags);
    } catch (const cv::Exception&) {
        image.pixels.release();
    }
    if (image.pixels.empty()) image.damage = "'" + path + "' is damaged or no image";
    return image;
}

std::string kindOf(const cv::Mat& pixels) {
    if (pixels.channels() > 1) return "a colour image";
    switch (pixels.depth()) {
        case CV_8U:
            return "8-bit";
        case CV_32F:
        case CV_64F:
            return "floating-point";
        default:
            return "of an unknown pixel type";
    }
}

[[noreturn]] void refuseDepth(const std::string& path, const std::string& kind) {
    throw Error("depth image '" + path + "' is " + kind,
                "depth must be 16-bit PNG with a fixed number of units a metre (--depth-units)");
}

}  // namespace

DecodedImage readColorImage(const std::string& path) {
    return decoded(path, bytesOf(path), cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
}

DecodedImage readDepthImage(const std::string& path) {
    const Bytes bytes = bytesOf(path);
    if (startsWith(bytes, exr_start)) refuseDepth(path, "OpenEXR, floating-point");
    DecodedImage image = decoded(path, bytes, cv::IMREAD_UNCHANGED);
    if (image.damage.empty() && image.pixels.type() != CV_16UC1) {
        refuseDepth(path, kindOf(image.pixels));
    }
    return image;
}

}  // namespace rgbd_graphslam
