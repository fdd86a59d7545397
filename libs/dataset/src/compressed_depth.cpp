#include "compressed_depth.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "lower_case.h"
#include "wire_reader.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t settings_bytes = 12, rvl_size_bytes = 8;
/** Deflate packs no denser than 1032 to 1. */
constexpr double most_pixels_per_byte = 1040;
/** An RVL image without readings takes a few bytes, whatever its size. */
constexpr double most_rvl_pixels = 1 << 24;

/** Numbers of any length in groups of three bits, eight groups to a word. */
class RvlReader {
  public:
    explicit RvlReader(std::string_view data) : in_(data) {}

    std::uint32_t number() {
        std::uint32_t value = 0, group = 0;
        int bits = 29;
        do {
            group = nextGroup();
            value |= (group & 7) << (29 - bits);
            bits -= 3;
        } while (group & 8 && bits > 0);
        return value;
    }

  private:
    std::uint32_t nextGroup() {
        if (groups_left_ == 0) {
            word_ = in_.number<std::uint32_t>();
            groups_left_ = 8;
        }
        const std::uint32_t group = word_ >> 28;
        word_ <<= 4;
        --groups_left_;
        return group;
    }

    WireReader in_;
    std::uint32_t word_ = 0;
    int groups_left_ = 0;
};

}  // namespace

cv::Mat decodeRvl(std::string_view data, cv::Size size) {
    cv::Mat1w depth(size, std::uint16_t{0});
    auto* pixel = depth.ptr<std::uint16_t>();
    std::size_t left = depth.total();
    RvlReader in(data);
    std::uint16_t previous = 0;
    try {
        while (left > 0) {
            const std::size_t zeros = in.number(), readings = in.number();
            if (zeros > left || readings > left - zeros) return {};
            pixel += zeros;
            for (std::size_t i = 0; i < readings; ++i) {
                const std::uint32_t step = in.number();
                const auto difference =
                    static_cast<std::int32_t>(step >> 1) ^ -static_cast<std::int32_t>(step & 1);
                previous = static_cast<std::uint16_t>(previous + difference);
                *pixel++ = previous;
            }
            left -= zeros + readings;
            if (zeros + readings == 0) return {};
        }
    } catch (const std::out_of_range&) {
        return {};
    }
    return depth;
}

CompressedDepth::CompressedDepth(std::string_view bytes, const std::string& format)
    : is_rvl_(contains(format, "rvl")), is_quantized_(lowerCase(format).rfind("32fc1", 0) == 0) {
    if (bytes.size() < settings_bytes) return;
    WireReader settings(bytes);
    settings.skip(4);  // which compression, as the format says
    quantum_a_ = settings.number<float>();
    quantum_b_ = settings.number<float>();
    payload_ = bytes.substr(settings_bytes);
}

cv::Size CompressedDepth::size() const {
    if (payload_.size() < 24) return {};
    WireReader in(payload_);
    if (!is_rvl_) in.skip(16);
    auto columns = in.number<std::uint32_t>(), rows = in.number<std::uint32_t>();
    if (!is_rvl_) {
        columns = __builtin_bswap32(columns);
        rows = __builtin_bswap32(rows);
    }
    constexpr std::uint32_t most = 1 << 15;
    if (columns > most || rows > most) return {};
    return {static_cast<int>(columns), static_cast<int>(rows)};
}

bool CompressedDepth::sizeIsPlausible() const {
    const cv::Size image = size();
    const double pixels = static_cast<double>(image.width) * image.height;
    const double most = most_pixels_per_byte * static_cast<double>(payload_.size());
    return pixels > 0 && pixels <= (is_rvl_ ? most_rvl_pixels : most);
}

cv::Mat CompressedDepth::decoded() const {
    if (!sizeIsPlausible()) return {};
    if (is_rvl_) return decodeRvl(payload_.substr(rvl_size_bytes), size());
    const cv::Mat bytes(1, static_cast<int>(payload_.size()), CV_8UC1,
                        const_cast<char*>(payload_.data()));
    try {
        const cv::Mat image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
        return image.type() == CV_16UC1 ? image : cv::Mat();
    } catch (const cv::Exception&) {
        return {};
    }
}

cv::Mat CompressedDepth::inMetres(const cv::Mat& values) const {
    cv::Mat1f meters(values.size(), 0.0F);
    for (int v = 0; v < values.rows; ++v) {
        for (int u = 0; u < values.cols; ++u) {
            const auto value = values.at<std::uint16_t>(v, u);
            if (value == 0) continue;
            const float depth = quantum_a_ / (static_cast<float>(value) - quantum_b_);
            if (std::isfinite(depth) && depth > 0) meters(v, u) = depth;
        }
    }
    return meters;
}

}  // namespace rgbd_graphslam
