#include "rgbd_graphslam/dataset/image_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "png_check.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using Bytes = std::vector<unsigned char>;

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

/** The decoder fills what a cut JPEG file lacks with gray and calls it a success. Cameras pad their
 *  files, hence the search. */
bool isCutJpeg(const Bytes& bytes) {
    if (!startsWith(bytes, jpeg_start)) return false;
    const auto tail = static_cast<std::ptrdiff_t>(std::min<std::size_t>(bytes.size(), 4096));
    return std::search(bytes.end() - tail, bytes.end(), jpeg_end.begin(), jpeg_end.end()) ==
           bytes.end();
}

/** What is wrong with a file before it is decoded; empty when nothing is. */
std::string damageOf(const Bytes& bytes) {
    const PngState png = checkPng(bytes);
    if (bytes.empty()) return "is empty or unreadable";
    if (png == PngState::CutOff || isCutJpeg(bytes)) return "is cut off";
    if (png == PngState::Damaged) return "is damaged, a check sum is wrong";
    return "";
}

DecodedImage decoded(const std::string& path, const Bytes& bytes, int flags) {
    const std::string damage = damageOf(bytes);
    if (!damage.empty()) return {{}, "'" + path + "' " + damage};
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
    if (pixels.channels() > 1) return "a color image";
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

/** \param meters CV_32FC1; without a finite positive number there is no reading */
cv::Mat1w inUnits(const cv::Mat1f& meters, double units) {
    cv::Mat1w depth(meters.size(), 0);
    for (int v = 0; v < meters.rows; ++v) {
        for (int u = 0; u < meters.cols; ++u) {
            const double reading = std::round(meters(v, u) * units);
            if (reading >= 1 && reading <= 65535) depth(v, u) = static_cast<std::uint16_t>(reading);
        }
    }
    return depth;
}

[[noreturn]] void refuseDepth(const std::string& path, const std::string& kind) {
    throw Error("depth image '" + path + "' is " + kind,
                "depth must be 16-bit PNG, TIFF or PGM with a fixed number of units per meter "
                "(--depth-units), or 32-bit float TIFF in meters");
}

}  // namespace

DecodedImage readColorImage(const std::string& path) {
    return decoded(path, bytesOf(path), cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
}

DecodedImage readGrayOrColorImage(const std::string& path) {
    return decoded(path, bytesOf(path), cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
}

DecodedImage readDepthImage(const std::string& path, double units) {
    const Bytes bytes = bytesOf(path);
    if (startsWith(bytes, exr_start)) refuseDepth(path, "OpenEXR, floating-point");
    DecodedImage image = decoded(path, bytes, cv::IMREAD_UNCHANGED);
    if (image.damage.empty() && image.pixels.type() == CV_32FC1) {
        image.pixels = inUnits(image.pixels, units);
        image.converted = true;
    }
    if (image.damage.empty() && image.pixels.type() != CV_16UC1) {
        refuseDepth(path, kindOf(image.pixels));
    }
    return image;
}

DecodedImage readLabelImage(const std::string& path) {
    DecodedImage image = decoded(path, bytesOf(path), cv::IMREAD_UNCHANGED);
    if (!image.damage.empty()) return image;
    if (image.pixels.type() == CV_8UC1) image.pixels.convertTo(image.pixels, CV_16U);
    if (image.pixels.type() != CV_16UC1) {
        throw Error("label image '" + path + "' is " + kindOf(image.pixels),
                    "write class numbers as a gray PNG of 8 or 16 bit, without a palette");
    }
    return image;
}

}  // namespace rgbd_graphslam
