/** Encodings of ROS's images. */
#include "../../../libs/dataset/src/ros_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "../../../libs/dataset/src/compressed_depth.h"
#include "../../support/problem_of.h"

namespace rgbd_graphslam {
namespace {

using ::testing::HasSubstr;

std::string_view bytesOf(const cv::Mat& pixels) {
    return {reinterpret_cast<const char*>(pixels.data), pixels.total() * pixels.elemSize()};
}

ros::Image imageOf(const cv::Mat& pixels, const std::string& encoding) {
    ros::Image image;
    image.height = static_cast<std::uint32_t>(pixels.rows);
    image.width = static_cast<std::uint32_t>(pixels.cols);
    image.step = static_cast<std::uint32_t>(pixels.cols * pixels.elemSize());
    image.encoding = encoding;
    image.data = bytesOf(pixels);
    return image;
}

/** A picture without sharp edges, which halved chrominance and mosaics keep. */
cv::Mat smoothPicture() {
    cv::Mat3b picture(24, 32);
    for (int v = 0; v < picture.rows; ++v) {
        for (int u = 0; u < picture.cols; ++u) {
            picture(v, u) = {static_cast<uchar>(80 + 2 * u), static_cast<uchar>(120 + 2 * v),
                             static_cast<uchar>(180 - 2 * u)};
        }
    }
    return picture;
}

/** Largest difference inside, where a mosaic's border does not matter. */
double difference(const cv::Mat& a, const cv::Mat& b) {
    const cv::Rect inside(4, 4, a.cols - 8, a.rows - 8);
    return cv::norm(a(inside), b(inside), cv::NORM_INF);
}

TEST(RosImages, everyColorEncodingGivesTheSamePicture) {
    const cv::Mat bgr = smoothPicture();
    for (const auto& [encoding, code] :
         std::vector<std::pair<std::string, int>>{{"rgb8", cv::COLOR_BGR2RGB},
                                                  {"rgba8", cv::COLOR_BGR2RGBA},
                                                  {"bgra8", cv::COLOR_BGR2BGRA}}) {
        cv::Mat pixels;
        cv::cvtColor(bgr, pixels, code);
        EXPECT_EQ(difference(ros::colorOf(imageOf(pixels, encoding)), bgr), 0) << encoding;
    }
    EXPECT_EQ(difference(ros::colorOf(imageOf(bgr, "bgr8")), bgr), 0);
    EXPECT_EQ(difference(ros::colorOf(imageOf(bgr, "8UC3")), bgr), 0);
}

TEST(RosImages, chrominanceOfEveryOtherColumnIsUnderstood) {
    const cv::Mat bgr = smoothPicture();
    cv::Mat yuv;
    cv::cvtColor(bgr, yuv, cv::COLOR_BGR2YUV);
    cv::Mat2b uyvy(bgr.size()), yuyv(bgr.size());
    for (int v = 0; v < bgr.rows; ++v) {
        for (int u = 0; u < bgr.cols; ++u) {
            const auto pixel = yuv.at<cv::Vec3b>(v, u);
            // Video's range: 16 to 235 and 16 to 240 (ITU-R BT.601).
            const auto y = cv::saturate_cast<uchar>(16 + pixel[0] * 219.0 / 255);
            const double factor = u % 2 == 0 ? 0.564 / 0.492 : 0.713 / 0.877;
            const auto c = cv::saturate_cast<uchar>(128 + (pixel[u % 2 == 0 ? 1 : 2] - 128) *
                                                              factor * 224.0 / 255);
            uyvy(v, u) = {c, y};
            yuyv(v, u) = {y, c};
        }
    }
    EXPECT_LT(difference(ros::colorOf(imageOf(uyvy, "yuv422")), bgr), 8);
    EXPECT_LT(difference(ros::colorOf(imageOf(yuyv, "yuv422_yuy2")), bgr), 8);
}

TEST(RosImages, mosaicsAreNamedByTheirFirstRows) {
    const cv::Mat bgr = smoothPicture();
    for (const std::string pattern : {"rggb", "bggr", "gbrg", "grbg"}) {
        cv::Mat1b mosaic(bgr.size());
        for (int v = 0; v < bgr.rows; ++v) {
            for (int u = 0; u < bgr.cols; ++u) {
                const char filter = pattern[static_cast<std::size_t>(2 * (v % 2) + u % 2)];
                const int channel = filter == 'b' ? 0 : filter == 'g' ? 1 : 2;
                mosaic(v, u) = bgr.at<cv::Vec3b>(v, u)[channel];
            }
        }
        const cv::Mat seen = ros::colorOf(imageOf(mosaic, "bayer_" + pattern + "8"));
        EXPECT_LT(difference(seen, bgr), 8) << pattern;
    }
}

TEST(RosImages, whatIsNotUnderstoodIsSaid) {
    const cv::Mat pixels(24, 32, CV_8UC3, cv::Scalar(1, 2, 3));
    EXPECT_THAT(problemOf([&] { ros::colorOf(imageOf(pixels, "h264")); }), HasSubstr("'h264'"));
    ros::Image cut = imageOf(pixels, "rgb8");
    cut.data.remove_suffix(1);
    EXPECT_THAT(problemOf([&] { ros::colorOf(cut); }), HasSubstr("is not whole"));
    ros::Image swapped = imageOf(cv::Mat(24, 32, CV_16UC1, cv::Scalar(1)), "16UC1");
    swapped.is_bigendian = true;
    EXPECT_THAT(problemOf([&] { ros::depthOf(swapped, 1000); }), HasSubstr("is big-endian"));
}

/** As compressed_depth_image_transport writes it. */
std::string packed(const std::string& extension, const cv::Mat& values, float a, float b) {
    std::vector<unsigned char> file;
    cv::imencode(extension, values, file);
    std::string bytes(4, '\0');
    bytes.append(reinterpret_cast<const char*>(&a), sizeof a);
    bytes.append(reinterpret_cast<const char*>(&b), sizeof b);
    return bytes.append(file.begin(), file.end());
}

TEST(CompressedDepth, inverseDepthBecomesMetres) {
    // 100 (100 + 1) and 1 - A / 10 m, for a quantization of 100.
    const float a = 10100, b = 1 - a / 10;
    cv::Mat1w values(4, 4, std::uint16_t{0});
    values(0, 0) = static_cast<std::uint16_t>(std::lround(a / 2.0F + b));
    values(0, 1) = static_cast<std::uint16_t>(std::lround(a / 0.5F + b));
    const std::string bytes = packed(".png", values, a, b);
    ros::CompressedImage image;
    image.format = "32FC1; compressedDepth png";
    image.data = bytes;
    EXPECT_EQ(ros::sizeOf(image), cv::Size(4, 4));
    const ros::ImageFile file = ros::depthFileOf(image, 1000);
    const cv::Mat depth =
        cv::imdecode(std::vector<char>(file.bytes.begin(), file.bytes.end()), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(depth.type(), CV_16UC1);
    EXPECT_NEAR(depth.at<std::uint16_t>(0, 0), 2000, 2);
    EXPECT_NEAR(depth.at<std::uint16_t>(0, 1), 500, 2);
    EXPECT_EQ(depth.at<std::uint16_t>(1, 1), 0) << "no reading";
}

/** Runs of zeros and differences, in groups of three bits, as the paper's listing writes them. */
class RvlWriter {
  public:
    void number(std::uint32_t value) {
        do {
            const std::uint32_t group = value & 7;
            value >>= 3;
            push(group | (value != 0 ? 8U : 0U));
        } while (value != 0);
    }
    std::string bytes() {
        while (groups_ != 0) push(0);
        return bytes_;
    }

  private:
    void push(std::uint32_t group) {
        word_ = word_ << 4 | group;
        if (++groups_ < 8) return;
        bytes_.append(reinterpret_cast<const char*>(&word_), sizeof word_);
        groups_ = 0;
    }
    std::string bytes_;
    std::uint32_t word_ = 0;
    int groups_ = 0;
};

TEST(CompressedDepth, rvlGivesBackEveryReading) {
    cv::Mat1w depth(6, 8);
    cv::RNG random(5);
    random.fill(depth, cv::RNG::UNIFORM, 0, 65536);
    depth.rowRange(0, 2).setTo(0);
    depth(3, 3) = 0;
    RvlWriter out;
    int previous = 0;
    for (std::size_t at = 0; at < depth.total();) {
        const auto value = [&](std::size_t i) { return depth.ptr<std::uint16_t>()[i]; };
        std::size_t readings = at;
        while (readings < depth.total() && value(readings) == 0) ++readings;
        std::size_t end = readings;
        while (end < depth.total() && value(end) != 0) ++end;
        out.number(static_cast<std::uint32_t>(readings - at));
        out.number(static_cast<std::uint32_t>(end - readings));
        for (at = readings; at < end; ++at) {
            const int step = value(at) - previous;
            out.number((static_cast<std::uint32_t>(step) << 1) ^
                       static_cast<std::uint32_t>(step >> 31));
            previous = value(at);
        }
    }
    const std::uint32_t size[2] = {8, 6};
    const std::string bytes = std::string(12, '\0') +
                              std::string(reinterpret_cast<const char*>(size), sizeof size) +
                              out.bytes();
    const CompressedDepth packed(bytes, "16UC1; compressedDepth rvl");
    EXPECT_EQ(packed.size(), cv::Size(8, 6));
    const cv::Mat decoded = packed.decoded();
    ASSERT_EQ(decoded.size(), depth.size());
    EXPECT_EQ(cv::norm(decoded, depth, cv::NORM_INF), 0);
    EXPECT_TRUE(CompressedDepth(bytes.substr(0, bytes.size() - 8), "rvl").decoded().empty())
        << "cut";
}

/** A header alone must not fill the memory. */
TEST(CompressedDepth, aSizeThatTheBytesCannotHoldIsNone) {
    std::string bytes = packed(".png", cv::Mat(4, 4, CV_16UC1, cv::Scalar(5)), 1, 1);
    bytes[12 + 17] = 0x40;
    bytes[12 + 21] = 0x40;
    EXPECT_TRUE(CompressedDepth(bytes, "16UC1; compressedDepth").decoded().empty());
}

}  // namespace
}  // namespace rgbd_graphslam
