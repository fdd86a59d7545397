#include "rgbd_graphslam/input/live_recorder.h"

#include <mrpt/obs/CObservationComment.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <stdexcept>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation;
namespace {

/** Of frames, with what came before each: 50 MB of 640x480 pixels. */
constexpr std::size_t most_batches = 32;

constexpr const char* beginning = "live run: it looked at %zu frames before tracking began";

CObservation::Ptr asComment(const std::string& text) {
    const auto comment = mrpt::obs::CObservationComment::Create();
    comment->timestamp = mrpt::Clock::time_point();  // the same in every run
    comment->text = text;
    return comment;
}

std::string beginningText(std::size_t survey_frames) {
    char text[80];
    std::snprintf(text, sizeof text, beginning, survey_frames);
    return text;
}

/** Ends the writing of a file that is not wanted any more. */
class GivenUp : public std::exception {};

}  // namespace

std::size_t surveyedFrames(const CObservation& observation) {
    const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&observation);
    if (!comment) return 0;
    std::size_t frames = 0;
    return std::sscanf(comment->text.c_str(), beginning, &frames) == 1 ? frames : 0;
}

LiveRecorder::LiveRecorder(const std::string& path, std::size_t survey_frames)
    : batches_(most_batches) {
    noted_.push_back(asComment(beginningText(survey_frames)));
    writer_ = std::thread([this, path] { write(path); });
}

LiveRecorder::~LiveRecorder() {
    batches_.close();
    if (writer_.joinable()) writer_.join();
}

void LiveRecorder::write(const std::string& path) {
    try {
        writeRawlog(path, RawlogStorage::Embedded, [this](RawlogWriter& writer) {
            while (const auto batch = batches_.pop()) {
                if (batch->empty()) return;  // the end
                for (const CObservation::Ptr& observation : *batch) writer.write(*observation);
            }
            throw GivenUp();
        });
    } catch (const GivenUp&) {
        return;
    } catch (...) {
        failure_ = std::current_exception();
    }
    batches_.close();
}

void LiveRecorder::note(CObservation::Ptr observation) {
    const std::lock_guard<std::mutex> lock(noting_);
    noted_.push_back(std::move(observation));
}

void LiveRecorder::comment(const std::string& text) {
    note(asComment("live run: " + text));
}

/** \return nothing where the image is not among what was noted */
LiveRecorder::Batch LiveRecorder::takeUpTo(const std::string& label,
                                           mrpt::Clock::time_point stamp) {
    const std::lock_guard<std::mutex> lock(noting_);
    const auto image = std::find_if(noted_.begin(), noted_.end(), [&](const auto& observation) {
        return observation->timestamp == stamp && observation->sensorLabel == label;
    });
    if (image == noted_.end()) return {};
    Batch batch(std::make_move_iterator(noted_.begin()), std::make_move_iterator(image + 1));
    noted_.erase(noted_.begin(), image + 1);
    return batch;
}

bool LiveRecorder::commit(const std::string& label, mrpt::Clock::time_point stamp) {
    Batch batch = takeUpTo(label, stamp);
    if (batch.empty() || said_failed_ || batches_.push(std::move(batch))) return !said_failed_;
    said_failed_ = true;
    sayWarning(
        "the record of this run cannot be written (is the disk full?); the run goes on "
        "without it");
    return false;
}

void LiveRecorder::finish() {
    batches_.push({});
    if (writer_.joinable()) writer_.join();
    if (failure_) std::rethrow_exception(failure_);
}

}  // namespace rgbd_graphslam
