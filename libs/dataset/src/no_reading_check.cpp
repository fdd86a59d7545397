#include "no_reading_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>

namespace rgbd_graphslam {
namespace {

constexpr double least_share = 0.03;   // of an image's pixels
constexpr double empty_before = 0.97;  // no reading between this and 1 times the value
constexpr double most_images = 0.8;    // of all must have it
constexpr double fewest_others = 0.1;  // of an image's pixels; a bare wall is no lack of readings
constexpr std::size_t fewest_images = 3;
constexpr double round_m = 0.5;

/** The largest reading, how many pixels have it, a little less, and any other. */
struct FarEnd {
    std::uint16_t value = 0;
    std::size_t pixels = 0, just_before = 0, others = 0;
};

FarEnd farEndOf(const cv::Mat1w& depth) {
    double greatest = 0;
    cv::minMaxLoc(depth, nullptr, &greatest);
    FarEnd end;
    end.value = static_cast<std::uint16_t>(greatest);
    for (const std::uint16_t reading : depth) {
        end.others += reading != 0 && reading != end.value;
        if (reading == end.value) {
            ++end.pixels;
        } else if (reading > empty_before * end.value) {
            ++end.just_before;
        }
    }
    return end;
}

}  // namespace

void NoReadingCheck::add(const cv::Mat& depth) {
    ++images_;
    const FarEnd end = farEndOf(depth);
    const auto total = static_cast<double>(depth.total());
    const double share = static_cast<double>(end.pixels) / total;
    if (static_cast<double>(end.others) < fewest_others * total) return;
    if (end.value == 0 || share < least_share || end.just_before > end.pixels / 100) return;
    Candidate& candidate = candidates_[end.value];
    ++candidate.images;
    candidate.shares += share;
}

bool NoReadingCheck::isUsual(std::uint16_t value) const {
    const bool all_ones = (value & (value + 1)) == 0 && value >= 1023;
    const double steps = value * unit_m_ / round_m;
    return all_ones || std::abs(steps - std::round(steps)) * round_m <= 0.5 * unit_m_ + 1e-9;
}

std::optional<NoReadingCheck::Finding> NoReadingCheck::finding() const {
    for (const auto& [value, candidate] : candidates_) {
        const double share_of_images =
            static_cast<double>(candidate.images) / static_cast<double>(images_);
        if (candidate.images < fewest_images || share_of_images < most_images) continue;
        if (!isUsual(value)) continue;
        return Finding{value, value * unit_m_, candidate.shares / static_cast<double>(images_)};
    }
    return std::nullopt;
}

std::string NoReadingCheck::Finding::text() const {
    char line[240];
    std::snprintf(line, sizeof line,
                  "depth is exactly %u (%.3g m) in %.0f %% of the pixels and never just below: "
                  "taken as no reading (to keep such readings pass --no-reading 0)",
                  static_cast<unsigned>(value), distance_m, 100 * share);
    return line;
}

}  // namespace rgbd_graphslam
