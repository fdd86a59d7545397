#include "rgbd_graphslam/dataset/registration_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>

#include "edge_maps.h"

namespace rgbd_graphslam {
namespace {

/** Widths that images are reduced to: for the search, and for the end of it. */
constexpr int coarse_width = 160, fine_width = 320;
constexpr std::size_t most_outlines = 600, fewest_outlines = 60, fewest_frames = 4;
/** Of the coarse image: shifts tried at each scale, and without scaling. */
constexpr int reach_scaled = 8, reach_unscaled = 20;
constexpr int scales_each_way = 35;  // steps of 2 % from 1/2 to 2
/** Of the fine image, around what the search found. */
constexpr int reach_fine = 4, fine_steps = 6;
constexpr double fine_step = 0.005;
constexpr double least_scale = 0.03, least_shift = 0.015;  // of the width
/** Even and odd frames must find the same. */
constexpr double halves_agree_scale = 0.05;
constexpr double halves_agree_px = 4;  // of the coarse image
/** Gain over the best near the place where depth is supposed to be: as a share of the agreement,
 * and over the frames in standard deviations of its mean. Agreement against chance: in standard
 *  deviations of all hypotheses. */
constexpr double least_gain = 0.05, least_significance = 2.5, least_agreement = 3;

}  // namespace

std::string toText(const Misregistration& found, double fx_px) {
    char text[240];
    if (found.isScaled()) {
        std::snprintf(text, sizeof text,
                      "depth seems to be %.2f times as large about the image center as it should: "
                      "it was probably never registered to color (focal length of the depth camera "
                      "about %.0f px, of the color camera %.0f px)",
                      found.scale, found.scale * fx_px, fx_px);
    } else {
        std::snprintf(text, sizeof text,
                      "depth seems shifted against color by %.0f px to the right and %.0f px down",
                      found.shift_px.x(), found.shift_px.y());
    }
    return text;
}

void RegistrationCheck::add(const cv::Mat& color, const cv::Mat& depth) {
    Frame frame;
    frame.outlines = depthOutlines(depth, most_outlines);
    if (frame.outlines.size() < fewest_outlines) return;
    width_ = color.cols;
    frame.coarse = edgeContrast(color, coarse_width);
    frame.fine = edgeContrast(color, fine_width);
    frames_.push_back(std::move(frame));
}

/** Of the even frames, the odd ones and all: the best hypothesis and how all are spread. */
struct RegistrationCheck::Search {
    struct Tally {
        Hypothesis best;
        double sum = 0, squares = 0;
        std::size_t count = 0;

        void take(double scale, const cv::Mat1d& agreements) {
            const int reach = agreements.cols / 2;
            for (int y = -reach; y <= reach; ++y) {
                for (int x = -reach; x <= reach; ++x) {
                    const double agreement = agreements(y + reach, x + reach);
                    if (count == 0 || agreement > best.agreement) {
                        best = {scale, {static_cast<double>(x), static_cast<double>(y)}, agreement};
                    }
                    sum += agreement;
                    squares += agreement * agreement;
                    ++count;
                }
            }
        }
        double mean() const { return sum / static_cast<double>(count); }
        double deviation() const {
            return std::sqrt(
                std::max(1e-12, squares / static_cast<double>(count) - mean() * mean()));
        }
    };
    std::array<Tally, 2> halves;
    Tally all;

    /** \return whether even and odd frames find the same */
    bool halvesAgree() const {
        const Hypothesis &a = halves[0].best, &b = halves[1].best;
        return std::abs(std::log(a.scale / b.scale)) < halves_agree_scale &&
               cv::norm(a.shift - b.shift) < halves_agree_px;
    }
};

RegistrationCheck::Search RegistrationCheck::searched() const {
    Search search;
    const auto tryAll = [&](double scale, int reach) {
        const int side = 2 * reach + 1;
        std::array<cv::Mat1d, 2> sums = {cv::Mat1d(side, side, 0.0), cv::Mat1d(side, side, 0.0)};
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            sums[i % 2] +=
                agreementAt(frames_[i].coarse, frames_[i].outlines, width_, {scale, {}}, reach);
        }
        for (int half = 0; half < 2; ++half) search.halves[half].take(scale, sums[half]);
        search.all.take(scale, sums[0] + sums[1]);
    };
    for (int step = -scales_each_way; step <= scales_each_way; ++step) {
        tryAll(std::pow(2, static_cast<double>(step) / scales_each_way), reach_scaled);
    }
    tryAll(1, reach_unscaled);
    return search;
}

RegistrationCheck::Hypothesis RegistrationCheck::refined(const Hypothesis& coarse) const {
    const double finer = static_cast<double>(frames_.front().fine.cols) /
                         static_cast<double>(frames_.front().coarse.cols);
    Hypothesis best;
    for (int step = -fine_steps; step <= fine_steps; ++step) {
        const Placement at{coarse.scale * (1 + fine_step * step), finer * coarse.shift};
        cv::Mat1d sum(2 * reach_fine + 1, 2 * reach_fine + 1, 0.0);
        for (const Frame& frame : frames_) {
            sum += agreementAt(frame.fine, frame.outlines, width_, at, reach_fine);
        }
        double agreement = 0;
        cv::Point place;
        cv::minMaxLoc(sum, nullptr, &agreement, nullptr, &place);
        if (step > -fine_steps && agreement <= best.agreement) continue;
        const cv::Point2d moved(place.x - reach_fine, place.y - reach_fine);
        best = {at.scale, at.shift + moved, agreement};
    }
    return best;
}

bool RegistrationCheck::isClearlyBetter(const Hypothesis& best, const Hypothesis& supposed) const {
    double sum = 0, squares = 0;
    for (const Frame& frame : frames_) {
        const auto agreement = [&](const Hypothesis& at) {
            return agreementAt(frame.fine, frame.outlines, width_, {at.scale, at.shift}, 0)(0, 0);
        };
        const double gain = agreement(best) - agreement(supposed);
        sum += gain;
        squares += gain * gain;
    }
    const auto count = static_cast<double>(frames_.size());
    const double variance = std::max(1e-9, squares / count - sum / count * (sum / count));
    return sum > least_gain * best.agreement &&
           sum / count > least_significance * std::sqrt(variance / count);
}

std::optional<Misregistration> RegistrationCheck::finding() const {
    if (frames_.size() < fewest_frames) return std::nullopt;
    const Search search = searched();
    if (!search.halvesAgree()) return std::nullopt;
    const Hypothesis best = refined(search.all.best), supposed = refined({});
    Misregistration found;
    found.scale = std::abs(best.scale - 1) < least_scale ? 1 : 1 / best.scale;
    const double pixels = static_cast<double>(width_) / frames_.front().fine.cols;
    found.shift_px = -pixels * Eigen::Vector2d(best.shift.x, best.shift.y);
    found.agreement = best.agreement / static_cast<double>(frames_.size());
    const bool is_off = found.isScaled() || found.shift_px.norm() >= least_shift * width_;
    const bool is_placed =
        best.agreement - search.all.mean() > least_agreement * search.all.deviation();
    if (!is_off || !is_placed || !isClearlyBetter(best, supposed)) return std::nullopt;
    return found;
}

}  // namespace rgbd_graphslam
