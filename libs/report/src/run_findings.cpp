#include "rgbd_graphslam/report/run_findings.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {
namespace {

constexpr int few_landmarks = 50;
constexpr const char* depth_scale_looks = "depth scale looks ";

std::string framesText(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " frame" : " frames");
}

class Findings {
  public:
    Findings(const RunRecord& run, const std::optional<AteResult>& ate) : run_(run), ate_(ate) {}

    std::vector<Finding> all() {
        aboutTheEnd();
        aboutLostFrames();
        aboutDepthScale();
        aboutLandmarks();
        for (const std::string& warning : run_.warnings) warn(warning);
        aboutLoops();
        if (run_.map_png.empty()) {
            note("no dense maps were made; run rgbd-map on this folder to make them");
        }
        return std::move(findings_);
    }

  private:
    void warn(std::string text) { findings_.push_back({Finding::Kind::Warning, std::move(text)}); }
    void note(std::string text) { findings_.push_back({Finding::Kind::Note, std::move(text)}); }

    void aboutTheEnd() {
        if (run_.interrupted) {
            warn("the run was interrupted: what follows is about its first " +
                 framesText(run_.frames.size()));
        }
        if (!run_.damage.empty()) warn("the recording ended early: " + run_.damage);
        if (run_.out_of_order > 0) {
            warn(framesText(run_.out_of_order) +
                 " left out because their stamps went back in time");
        }
    }

    /** The longest ones one by one, in order of time. */
    void aboutLostFrames() {
        constexpr std::size_t most = 5;
        auto spans = lostSpans(run_.frames);
        std::vector<LostSpan> rest;
        if (spans.size() > most) {
            std::stable_sort(spans.begin(), spans.end(),
                             [](const auto& a, const auto& b) { return a.frames > b.frames; });
            rest.assign(spans.begin() + most, spans.end());
            spans.resize(most);
            std::sort(spans.begin(), spans.end(),
                      [](const auto& a, const auto& b) { return a.first_s < b.first_s; });
        }
        for (const LostSpan& span : spans) warn(spanText(span));
        if (rest.empty()) return;
        std::size_t frames = 0;
        for (const LostSpan& span : rest) frames += span.frames;
        warn(framesText(frames) + " lost in " + std::to_string(rest.size()) + " shorter spans");
    }

    static std::string spanText(const LostSpan& span) {
        const char* end = span.recovered ? ", recovered" : ", not found again";
        if (span.frames == 1) return formatted("1 frame lost at %.1f s", span.first_s) + end;
        return framesText(span.frames) +
               formatted(" lost between %.1f s and %.1f s", span.first_s, span.last_s) + end;
    }

    void aboutDepthScale() {
        const bool said = std::any_of(
            run_.warnings.begin(), run_.warnings.end(),
            [](const std::string& warning) { return warning.rfind(depth_scale_looks, 0) == 0; });
        if (!ate_ || said) return;
        const std::string text = depthScaleFinding(*ate_);
        if (!text.empty()) warn(text);
    }

    void aboutLandmarks() {
        std::size_t few = 0, located = 0;
        for (const ReportedFrame& frame : run_.frames) {
            if (frame.state == FrameState::Lost) continue;
            ++located;
            few += frame.inliers < few_landmarks;
        }
        if (few * 10 < located || few == 0) return;
        warn(formatted(
            "%.0f %% of the tracked frames have fewer than %d inliers: little "
            "texture, blur, darkness or people in front of the camera",
            100. * static_cast<double>(few) / static_cast<double>(located), few_landmarks));
    }

    void aboutLoops() {
        if (run_.loops.empty()) {
            if (run_.path_m > 10) note("no loop was closed: drift is not corrected");
            return;
        }
        double largest_m = 0;
        const auto& before = run_.keyframes_before_loops;
        for (std::size_t i = 0; i < std::min(before.size(), run_.keyframes.size()); ++i) {
            largest_m = std::max(
                largest_m, (before[i].T_world_cam.t - run_.keyframes[i].T_world_cam.t).norm());
        }
        if (const std::size_t wrong = run_.false_loops.value_or(0); wrong > 0) {
            warn(formatted(
                "%zu of %zu loops %s false: the truth says that the places %s not the same", wrong,
                run_.loops.size(), wrong == 1 ? "is" : "are",
                wrong == 1 ? "it joins are" : "they join are"));
        }
        note(std::to_string(run_.loops.size()) + (run_.loops.size() == 1 ? " loop" : " loops") +
             formatted(" closed; loop closure moved keyframes by up to %.2f m", largest_m));
    }

    const RunRecord& run_;
    const std::optional<AteResult>& ate_;
    std::vector<Finding> findings_;
};

}  // namespace

std::vector<LostSpan> lostSpans(const std::vector<ReportedFrame>& frames) {
    std::vector<LostSpan> spans;
    bool lost_before = false;
    for (const ReportedFrame& frame : frames) {
        const bool lost = frame.state == FrameState::Lost;
        if (lost && !lost_before) spans.push_back({0, frame.seconds, frame.seconds, false});
        if (lost) {
            ++spans.back().frames;
            spans.back().last_s = frame.seconds;
        } else if (lost_before) {
            spans.back().recovered = true;
        }
        lost_before = lost;
    }
    return spans;
}

std::optional<double> depthScaleError(const AteResult& ate) {
    // Drift looks like a scale, too, but leaves most of the error unexplained.
    constexpr double least = 0.01, least_explained = 0.6, least_rms_m = 0.005;
    if (!ate.fitted_scale || *ate.fitted_scale <= 0 || ate.pairs.empty()) return std::nullopt;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const AtePair& pair : ate.pairs) mean += pair.aligned_m;
    mean /= static_cast<double>(ate.pairs.size());
    double spread = 0, error = 0;
    for (const AtePair& pair : ate.pairs) {
        spread += (pair.aligned_m - mean).squaredNorm();
        error += pair.error_m().squaredNorm();
    }
    // The sum of squares is a parabola in the scale, with `spread` before the square.
    const double off = *ate.fitted_scale - 1;
    const double rms_m = std::abs(off) * std::sqrt(spread / static_cast<double>(ate.pairs.size()));
    if (std::abs(off) < least || rms_m < least_rms_m) return std::nullopt;
    if (spread * off * off < least_explained * error) return std::nullopt;
    return 1 / *ate.fitted_scale - 1;
}

std::string depthScaleFinding(const AteResult& ate) {
    const auto error = depthScaleError(ate);
    if (!error) return {};
    return depth_scale_looks +
           formatted(
               "%.1f %% too %s: against the ground truth, depths fit best when multiplied by "
               "%.3f (depth_scale in camera.ini)",
               100 * std::abs(*error), *error > 0 ? "large" : "small", 1 / (1 + *error));
}

std::vector<Finding> findingsOf(const RunRecord& run, const std::optional<AteResult>& ate) {
    return Findings(run, ate).all();
}

}  // namespace rgbd_graphslam
