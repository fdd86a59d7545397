#include "rgbd_graphslam/dataset/lag_check.h"

#include <algorithm>
#include <cmath>

#include "edge_maps.h"

namespace rgbd_graphslam {
namespace {

constexpr int reduced_width = 320;
constexpr std::size_t anchors_wanted = 12, fewest_anchors = 4;
constexpr std::size_t most_outlines = 600, fewest_outlines = 60;
constexpr int longest_frames = 15;
constexpr double longest_s = 0.75;
/** Of the mean gain over no lag, in standard deviations of it; share of anchors that gain. */
constexpr double least_significance = 4, least_share = 0.75;
constexpr double least_agreement = 3;  // standard deviations a frame
/** Share of the agreement that may be left without lag. Steady motion past things whose outlines
 * have color edges beside them gains, too, but less. */
constexpr double most_left = 0.65;

/** Small lags one by one, larger ones with gaps. */
bool isTried(int lag) {
    const int size = std::abs(lag);
    return size <= 6 || (size <= longest_frames && (size % 2 == 0 || size == longest_frames));
}

}  // namespace

LagCheck::LagCheck(std::size_t frames)
    : stride_(std::max<std::size_t>(1, frames / anchors_wanted)) {}

bool LagCheck::isCompared(std::size_t frame) const {
    for (int lag = -longest_frames; lag <= longest_frames; ++lag) {
        const auto anchor = static_cast<std::ptrdiff_t>(frame) + lag;
        if (anchor >= 0 && isTried(lag) && isAnchor(static_cast<std::size_t>(anchor))) return true;
    }
    return false;
}

void LagCheck::add(double stamp_s, const cv::Mat& color, const cv::Mat& depth) {
    const std::size_t frame = frames_++;
    if (!isCompared(frame)) return;
    colors_[frame] = {stamp_s, edgeContrast(color, reduced_width)};
    if (colors_.size() > static_cast<std::size_t>(longest_frames) + 1) {
        colors_.erase(colors_.begin());
    }
    if (isAnchor(frame)) {
        Anchor anchor{stamp_s, color.cols, depthOutlines(depth, most_outlines), {}, {}};
        if (anchor.outlines.size() >= fewest_outlines) anchors_[frame] = std::move(anchor);
        for (const auto& [earlier, image] : colors_) compare(frame, earlier);
    }
    for (const auto& [earlier, anchor] : anchors_) {
        if (earlier < frame && earlier + longest_frames >= frame) compare(earlier, frame);
    }
}

void LagCheck::compare(std::size_t anchor, std::size_t color) {
    const auto found = anchors_.find(anchor);
    const int lag = static_cast<int>(anchor) - static_cast<int>(color);
    if (found == anchors_.end() || !isTried(lag)) return;
    Anchor& depth = found->second;
    const Color& image = colors_.at(color);
    const double delay_s = depth.stamp_s - image.stamp_s;
    if (std::abs(delay_s) > longest_s) return;
    depth.delays_s[lag] = delay_s;
    depth.agreements[lag] =
        agreementAt(image.contrast, depth.outlines, depth.width, {1, {0, 0}}, 0)(0, 0);
}

std::optional<DepthLag> LagCheck::finding() const {
    DepthLag best;
    double best_gain = 0;
    for (int lag = -longest_frames; lag <= longest_frames; ++lag) {
        double gain = 0, squares = 0, agreement = 0, delay_s = 0;
        int count = 0, gaining = 0;
        for (const auto& [frame, anchor] : anchors_) {
            if (anchor.agreements.count(lag) == 0 || anchor.agreements.count(0) == 0) continue;
            const double difference = anchor.agreements.at(lag) - anchor.agreements.at(0);
            gain += difference;
            squares += difference * difference;
            agreement += anchor.agreements.at(lag);
            delay_s += anchor.delays_s.at(lag);
            gaining += difference > 0;
            ++count;
        }
        if (lag == 0 || count < static_cast<int>(fewest_anchors)) continue;
        gain /= count;
        const double variance = std::max(1e-9, squares / count - gain * gain);
        const bool clear = gain / std::sqrt(variance / count) > least_significance &&
                           gaining >= least_share * count && agreement > least_agreement * count &&
                           gain > (1 - most_left) * agreement / count;
        if (!clear || gain <= best_gain) continue;
        best_gain = gain;
        best = {delay_s / count, lag, agreement / count};
    }
    if (best.frames == 0) return std::nullopt;
    return best;
}

}  // namespace rgbd_graphslam
