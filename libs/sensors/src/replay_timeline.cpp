#include "replay_timeline.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <algorithm>
#include <mutex>
#include <opencv2/core.hpp>
#include <utility>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation;
namespace {

/** Between the last observation of a pass and the first of the next. */
constexpr double pause_s = 1.0 / 30;

/** A sensor's images are in memory; those of a rawlog may be files. */
void embed(mrpt::img::CImage& image) {
    if (!image.isExternallyStored()) return;
    image.forceLoad();
    image =
        mrpt::img::CImage(image.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY), mrpt::img::DEEP_COPY);
}

void embedImages(CObservation& observation) {
    if (auto* frame = dynamic_cast<mrpt::obs::CObservation3DRangeScan*>(&observation)) {
        frame->load();
        frame->rangeImage_forceResetExternalStorage();
        if (frame->hasIntensityImage) embed(frame->intensityImage);
        if (frame->hasConfidenceImage) embed(frame->confidenceImage);
    } else if (auto* pair = dynamic_cast<mrpt::obs::CObservationStereoImages*>(&observation)) {
        embed(pair->imageLeft);
        if (pair->hasImageRight) embed(pair->imageRight);
    } else if (auto* image = dynamic_cast<mrpt::obs::CObservationImage*>(&observation)) {
        embed(image->image);
    }
}

void addSeconds(double seconds, CObservation& observation) {
    if (seconds == 0) return;
    observation.timestamp +=
        std::chrono::duration_cast<mrpt::Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

ReplayTimeline::ReplayTimeline(const ReplaySettings& settings)
    : settings_(settings),
      reader_(std::make_unique<RawlogReader>(settings.rawlog)),
      passes_left_(settings.repeat - 1),
      state_(settings.seed) {}

/** Comments are no measurements. */
CObservation::Ptr ReplayTimeline::read() {
    static std::mutex one_rawlog;  // MRPT has one folder of images a process
    const std::lock_guard<std::mutex> lock(one_rawlog);
    while (auto observation = reader_->next()) {
        const bool comment = dynamic_cast<mrpt::obs::CObservationComment*>(observation.get());
        if (comment || observation->timestamp == INVALID_TIMESTAMP) continue;
        const bool wanted =
            settings_.labels.empty() || settings_.labels.count(observation->sensorLabel);
        if (wanted) embedImages(*observation);
        return observation;
    }
    return nullptr;
}

void ReplayTimeline::readUntil(double time_s) {
    while (!at_end_ && read_until_s_ <= time_s) {
        at_end_ = true;  // for good, should reading throw
        const auto observation = read();
        if (observation) {
            at_end_ = false;
            place(observation);
        } else if (passes_left_ > 0 && first_s_) {
            --passes_left_;
            at_end_ = false;
            pass_begins_s_ += last_s_ - *first_s_ + pause_s;
            reader_ = std::make_unique<RawlogReader>(settings_.rawlog);
        }
    }
}

void ReplayTimeline::place(const CObservation::Ptr& observation) {
    const double stamp_s = toSeconds(observation->timestamp);
    if (!first_s_) first_s_ = stamp_s;
    last_s_ = std::max(last_s_, stamp_s);
    const double taken_s = pass_begins_s_ + stamp_s - *first_s_;
    read_until_s_ = std::max(read_until_s_, taken_s);
    if (!settings_.labels.empty() && !settings_.labels.count(observation->sensorLabel)) return;
    const bool lost = random() < settings_.loss, late = random() < settings_.reorder;
    const double delay_s = settings_.jitter_s * random() + (late ? settings_.reorder_s : 0);
    if (lost || settings_.silent(taken_s) || settings_.unplugged(taken_s)) return;
    const bool after_jump = taken_s >= settings_.clock_jump_at_s;
    addSeconds(pass_begins_s_ + (after_jump ? settings_.clock_jump_s : 0), *observation);
    due_.emplace(taken_s + delay_s * settings_.speed, observation);
}

/** SplitMix64 (Steele et al. 2014). \return 0 to 1 */
double ReplayTimeline::random() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

CObservation::Ptr ReplayTimeline::take(double time_s) {
    if (due_.empty() || due_.begin()->first > time_s) return nullptr;
    auto observation = std::move(due_.begin()->second);
    due_.erase(due_.begin());
    if (settings_.stamped_now)
        addSeconds(toSeconds(mrpt::Clock::now()) - toSeconds(observation->timestamp), *observation);
    return observation;
}

std::optional<double> ReplayTimeline::nextDue() const {
    if (!due_.empty()) return due_.begin()->first;
    if (at_end_) return std::nullopt;
    return read_until_s_;
}

}  // namespace rgbd_graphslam
