#include "ros_images.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "compressed_depth.h"
#include "lower_case.h"
#include "number_text.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam::ros {
namespace {

[[noreturn]] void refuse(const Header& header, const std::string& why, const std::string& remedy) {
    throw Error("the image at " + stampText(header.stamp_s) + " " + why, remedy);
}

/** How an encoding lies in memory, and how it becomes BGR; -1: it is. */
struct ColorFormat {
    int type, to_bgr;
};

/** Names of sensor_msgs/image_encodings.h; yuv422 is ordered UYVY. */
const std::map<std::string, ColorFormat>& colorFormats() {
    static const std::map<std::string, ColorFormat> formats = {
        {"rgb8", {CV_8UC3, cv::COLOR_RGB2BGR}},
        {"bgr8", {CV_8UC3, -1}},
        {"8uc3", {CV_8UC3, -1}},
        {"rgba8", {CV_8UC4, cv::COLOR_RGBA2BGR}},
        {"bgra8", {CV_8UC4, cv::COLOR_BGRA2BGR}},
        {"8uc4", {CV_8UC4, cv::COLOR_BGRA2BGR}},
        {"yuv422", {CV_8UC2, cv::COLOR_YUV2BGR_UYVY}},
        {"uyvy", {CV_8UC2, cv::COLOR_YUV2BGR_UYVY}},
        {"yuv422_yuy2", {CV_8UC2, cv::COLOR_YUV2BGR_YUY2}},
        {"yuyv", {CV_8UC2, cv::COLOR_YUV2BGR_YUY2}},
        {"bayer_rggb8", {CV_8UC1, cv::COLOR_BayerRGGB2BGR}},
        {"bayer_bggr8", {CV_8UC1, cv::COLOR_BayerBGGR2BGR}},
        {"bayer_gbrg8", {CV_8UC1, cv::COLOR_BayerGBRG2BGR}},
        {"bayer_grbg8", {CV_8UC1, cv::COLOR_BayerGRBG2BGR}},
        {"mono8", {CV_8UC1, -1}},
        {"8uc1", {CV_8UC1, -1}}};
    return formats;
}

/** The message's bytes as an image; rows may be padded. */
cv::Mat pixelsOf(const Image& image, int type) {
    const std::size_t row_bytes = std::size_t{image.width} * CV_ELEM_SIZE(type);
    const bool swapped = image.is_bigendian && CV_ELEM_SIZE1(type) > 1;
    if (swapped || image.width == 0 || image.height == 0 || image.step < row_bytes ||
        image.data.size() / image.step < image.height) {
        refuse(image.header, swapped ? "is big-endian" : "is not whole",
               "copy the recording again");
    }
    const int rows = static_cast<int>(image.height), columns = static_cast<int>(image.width);
    char* const bytes = const_cast<char*>(image.data.data());
    if (CV_ELEM_SIZE1(type) == 1) return {rows, columns, type, bytes, image.step};
    cv::Mat pixels(rows, columns, type);  // bytes of a message may start at any address
    for (int v = 0; v < rows; ++v) {
        std::memcpy(pixels.ptr(v), bytes + std::size_t{image.step} * v, row_bytes);
    }
    return pixels;
}

ImageFile fileOf(const std::string& extension, const cv::Mat& pixels) {
    std::vector<unsigned char> bytes;
    cv::imencode(extension, pixels, bytes);
    return {extension, {bytes.begin(), bytes.end()}};
}

/** No camera has more columns or rows. */
constexpr std::uint32_t most_pixels = 1 << 15;

bool isJpeg(std::string_view bytes) {
    return bytes.substr(0, 2) == "\xff\xd8";
}

bool isPng(std::string_view bytes) {
    return bytes.substr(0, 4) == "\x89PNG";
}

std::uint32_t bigEndian(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (const char byte : bytes.substr(std::min(at, bytes.size()), count)) {
        value = value << 8 | static_cast<unsigned char>(byte);
    }
    return value;
}

cv::Size sizeOfPng(std::string_view bytes) {
    const std::uint32_t columns = bigEndian(bytes, 16, 4), rows = bigEndian(bytes, 20, 4);
    if (columns > most_pixels || rows > most_pixels) return {};
    return {static_cast<int>(columns), static_cast<int>(rows)};
}

/** Of the frame header, the first of the markers SOF0 to SOF15 that is one (JPEG, ITU-T T.81). */
cv::Size sizeOfJpeg(std::string_view bytes) {
    for (std::size_t at = 2; at + 9 < bytes.size();) {
        const auto marker = static_cast<unsigned char>(bytes[at + 1]);
        const bool is_frame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (is_frame) {
            return {static_cast<int>(bigEndian(bytes, at + 7, 2)),
                    static_cast<int>(bigEndian(bytes, at + 5, 2))};
        }
        at += 2 + bigEndian(bytes, at + 2, 2);
    }
    return {};
}

cv::Mat1w inUnits(const cv::Mat& meters, double units) {
    cv::Mat1w depth(meters.size());
    for (int v = 0; v < depth.rows; ++v) {
        const auto* from = meters.ptr<float>(v);
        auto* to = depth.ptr<std::uint16_t>(v);
        for (int u = 0; u < depth.cols; ++u) {
            const double value = std::round(static_cast<double>(from[u]) * units);
            const bool fits = value > 0 && value <= std::numeric_limits<std::uint16_t>::max();
            to[u] = fits ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
        }
    }
    return depth;
}

double largestOf(const cv::Mat& meters) {
    double largest = 0;
    for (int v = 0; v < meters.rows; ++v) {
        for (int u = 0; u < meters.cols; ++u) {
            const float value = meters.at<float>(v, u);
            if (std::isfinite(value)) largest = std::max<double>(largest, value);
        }
    }
    return largest;
}

}  // namespace

std::string encodingOf(const CompressedImage& image) {
    return lowerCase(image.format.substr(0, image.format.find_first_of("; ")));
}

bool isCompressedDepth(const CompressedImage& image) {
    return image.format.find("compressedDepth") != std::string::npos;
}

cv::Size sizeOf(const CompressedImage& image) {
    if (isCompressedDepth(image)) return CompressedDepth(image.data, image.format).size();
    if (isPng(image.data)) return sizeOfPng(image.data);
    return isJpeg(image.data) ? sizeOfJpeg(image.data) : cv::Size();
}

bool isGrayEncoding(const std::string& encoding) {
    return encoding == "mono8" || encoding == "8uc1";
}

bool isColorEncoding(const std::string& encoding) {
    return colorFormats().count(encoding) > 0 && !isGrayEncoding(encoding);
}

bool isDepthEncoding(const std::string& encoding) {
    return encoding == "32fc1" || encoding == "16uc1" || encoding == "mono16";
}

cv::Mat colorOf(const Image& image) {
    const auto format = colorFormats().find(lowerCase(image.encoding));
    if (format == colorFormats().end()) {
        refuse(image.header, "has the unknown encoding '" + image.encoding + "'",
               "choose another topic with --color-topic");
    }
    const cv::Mat pixels = pixelsOf(image, format->second.type);
    if (format->second.to_bgr < 0) return pixels;
    const bool pairs_columns = format->second.type == CV_8UC2;
    if (pairs_columns && pixels.cols % 2 != 0) {
        refuse(image.header, "has an odd number of columns", "copy the recording again");
    }
    cv::Mat bgr;
    cv::cvtColor(pixels, bgr, format->second.to_bgr);
    return bgr;
}

ImageFile colorFileOf(const Image& image) {
    const cv::Mat color = colorOf(image);
    return fileOf(color.channels() == 1 ? ".pgm" : ".ppm", color);
}

ImageFile colorFileOf(const CompressedImage& image) {
    if (!isJpeg(image.data) && !isPng(image.data)) {
        refuse(image.header, "is compressed as '" + image.format + "'",
               "only JPEG and PNG are supported");
    }
    return {isJpeg(image.data) ? ".jpg" : ".png", std::string(image.data)};
}

cv::Mat1w depthOf(const Image& image, double units) {
    const bool meters = lowerCase(image.encoding) == "32fc1";
    const cv::Mat pixels = pixelsOf(image, meters ? CV_32FC1 : CV_16UC1);
    if (!meters) return pixels;
    return inUnits(pixels, units);
}

ImageFile depthFileOf(const Image& image, double units) {
    return fileOf(".pgm", depthOf(image, units));
}

ImageFile depthFileOf(const CompressedImage& image, double units) {
    if (!isCompressedDepth(image)) return colorFileOf(image);
    const CompressedDepth depth(image.data, image.format);
    if (!depth.isQuantized() && depth.isPng()) return {".png", std::string(depth.payload())};
    cv::Mat pixels = depth.decoded();
    if (pixels.empty()) refuse(image.header, "is damaged", "copy the recording again");
    if (depth.isQuantized()) pixels = inUnits(depth.inMetres(pixels), units);
    return fileOf(".pgm", pixels);
}

double largestDepth(const Image& image) {
    const bool meters = lowerCase(image.encoding) == "32fc1";
    return meters ? largestOf(pixelsOf(image, CV_32FC1)) : 0;
}

double largestDepth(const CompressedImage& image) {
    if (!isCompressedDepth(image)) return 0;
    const CompressedDepth depth(image.data, image.format);
    return depth.isQuantized() ? largestOf(depth.inMetres(depth.decoded())) : 0;
}

}  // namespace rgbd_graphslam::ros
