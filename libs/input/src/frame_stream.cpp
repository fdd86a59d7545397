#include "rgbd_graphslam/input/frame_stream.h"

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <exception>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "dead_reckoner.h"
#include "rgbd_graphslam/core/bounded_queue.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation3DRangeScan;

namespace {

void checkSize(const RgbdImage& image, const Camera& camera, std::size_t index) {
    if (image.depth.cols == camera.width && image.depth.rows == camera.height) return;
    throw Error("frame " + std::to_string(index) + " is " + std::to_string(image.depth.cols) + "x" +
                    std::to_string(image.depth.rows) + " pixels, its camera's calibration is for " +
                    std::to_string(camera.width) + "x" + std::to_string(camera.height),
                "import the sequence with the calibration of its camera");
}

void checkStamp(const CObservation3DRangeScan& frame, std::size_t index) {
    if (frame.timestamp != INVALID_TIMESTAMP) return;
    throw Error("frame " + std::to_string(index) + " of the rawlog has no timestamp",
                "export it with 'rawlog2tum RAWLOG DIR --rate HZ', which stamps such frames by "
                "their number, and import DIR with rgbd-import");
}

}  // namespace

class FrameStream::Implementation {
  public:
    Implementation(std::unique_ptr<ObservationSource> source, const ReadAhead& ahead,
                   const std::string& sensor_label)
        : threads_(ahead.threads),
          sensor_label_(sensor_label),
          source_(std::move(source)),
          queue_(static_cast<std::size_t>(ahead.frames)) {
        auto frame = readFrame();
        if (!frame) refuse();
        pending_.push_back(std::move(*frame));
    }

    std::vector<CObservation3DRangeScan::Ptr> lookAhead(std::size_t frames) {
        try {
            while (pending_.size() < frames) {
                auto frame = readFrame();
                if (!frame) break;
                pending_.push_back(std::move(*frame));
            }
        } catch (...) {
            damage_ = std::current_exception();
        }
        std::vector<CObservation3DRangeScan::Ptr> observations;
        for (const StreamedFrame& frame : pending_) observations.push_back(frame.observation);
        return observations;
    }

    ~Implementation() { stop(); }

    std::optional<StreamedFrame> skip() { return takeFrame(); }

    void start(Prepare prepare) {
        prepare_ = std::move(prepare);
        busy_workers_ = threads_ - 1;
        for (int i = 0; i < threads_ - 1; ++i) workers_.emplace_back([this] { work(); });
    }

    void stop() {
        queue_.close();
        for (std::thread& worker : workers_) worker.join();
        workers_.clear();
    }

    std::optional<StreamedFrame> next() {
        if (workers_.empty()) {
            auto frame = takeFrame();
            if (frame) prepare(*frame);
            return frame;
        }
        auto coming = queue_.pop();
        if (!coming) return std::nullopt;
        return coming->get();
    }

    const CObservation3DRangeScan& firstFrame() const { return *first_; }
    const StageTimes& times() const { return times_; }
    std::size_t expectedFrames() const { return expected_frames_; }
    Trajectory truth() const {
        const std::lock_guard<std::mutex> lock(notes_access_);
        return truth_;
    }
    std::vector<SensorRecord> sensors() const {
        const std::lock_guard<std::mutex> lock(notes_access_);
        return census_.sensors();
    }

  private:
    /** \throws Error saying what the source has in place of frames of the camera asked for */
    [[noreturn]] void refuse() const {
        const std::string holds = "; it has " + sensorsText(census_.sensors(), false);
        if (sensor_label_.empty()) {
            throw Error(source_->name() + " has no RGB-D frame (CObservation3DRangeScan)" + holds,
                        "import a sequence with rgbd-import");
        }
        throw Error(source_->name() + " has no RGB-D camera '" + sensor_label_ + "'" + holds,
                    "give --sensor the label of an RGB-D camera, or leave it out");
    }

    void work() {
        while (workOnOne()) continue;
        if (--busy_workers_ == 0) queue_.close();
    }

    bool workOnOne() {
        std::promise<StreamedFrame> promise;
        auto frame = takeFrame(promise);
        if (!frame) return false;
        try {
            prepare(*frame);
            promise.set_value(std::move(*frame));
        } catch (...) {
            promise.set_exception(std::current_exception());
        }
        return true;
    }

    /** The frame's place in the queue is taken while nobody else reads, which keeps the order. */
    std::optional<StreamedFrame> takeFrame(std::promise<StreamedFrame>& promise) {
        const std::lock_guard<std::mutex> lock(reading_);
        std::optional<StreamedFrame> frame;
        std::exception_ptr damage;
        try {
            frame = takeFrame();
        } catch (...) {
            damage = std::current_exception();
        }
        if (!frame && !damage) return std::nullopt;
        if (!queue_.push(promise.get_future())) return std::nullopt;
        if (damage) promise.set_exception(damage);
        return frame;
    }

    std::optional<StreamedFrame> takeFrame() {
        std::optional<StreamedFrame> frame;
        if (!pending_.empty()) {
            frame = std::move(pending_.front());
            pending_.pop_front();
            return frame;
        }
        if (damage_) std::rethrow_exception(std::exchange(damage_, nullptr));
        times_.measure("read", [&] { frame = readFrame(); });
        return frame;
    }

    std::optional<StreamedFrame> readFrame() {
        if (ended_) return std::nullopt;
        ended_ = true;  // for good, should reading throw
        while (const auto observation = source_->next()) {
            auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
            if (!first_ && frame && isWanted(*frame)) {
                first_ = frame;
                camera_ = cameraOf(*frame);
            }
            note(*observation);
            if (!frame) {
                before_.push_back(observation);
                continue;
            }
            if (!first_ || frame->sensorLabel != first_->sensorLabel) continue;  // another camera
            ended_ = false;
            const std::size_t index = frames_read_++;
            checkStamp(*frame, index);
            const double share = source_->progress().value_or(1);
            expected_frames_ = std::lround(frames_read_ / std::max(1e-9, share));
            const DeadReckoning reckoning =
                reckoner_.at(toSeconds(frame->timestamp), cameraOnRobot(*first_));
            return StreamedFrame{
                std::exchange(before_, {}), index, std::move(frame), {}, reckoning};
        }
        return std::nullopt;
    }

    bool isWanted(const CObservation3DRangeScan& frame) const {
        return sensor_label_.empty() || frame.sensorLabel == sensor_label_;
    }

    void note(const mrpt::obs::CObservation& observation) {
        reckoner_.note(observation);
        const std::lock_guard<std::mutex> lock(notes_access_);
        noteTruth(observation);
        census_.note(observation, isUsed(observation));
    }

    /** Wheels, IMU, truth, the stamps in comments, and the frames themselves. */
    bool isUsed(const mrpt::obs::CObservation& observation) const {
        using namespace mrpt::obs;
        if (dynamic_cast<const CObservation3DRangeScan*>(&observation))
            return first_ && observation.sensorLabel == first_->sensorLabel;
        if (dynamic_cast<const CObservationRobotPose*>(&observation))
            return observation.sensorLabel == ground_truth_label;
        return dynamic_cast<const CObservationIMU*>(&observation) ||
               dynamic_cast<const CObservationOdometry*>(&observation) ||
               dynamic_cast<const CObservationComment*>(&observation);
    }

    void noteTruth(const mrpt::obs::CObservation& observation) {
        const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation);
        if (!pose || pose->sensorLabel != ground_truth_label) return;
        const SE3 T_truth_robot = toSE3(pose->pose.mean);
        if (!T_truth_robot.R.allFinite() || !T_truth_robot.t.allFinite()) return;
        truth_.push_back({toSeconds(pose->timestamp), T_truth_robot});
    }

    void prepare(StreamedFrame& frame) {
        RgbdImage image;
        times_.measure("decode", [&] { image = toRgbdImage(frame.observation); });
        checkSize(image, camera_, frame.index);
        frame.prepared = prepare_(image);
        frame.prepared.reckoning = frame.reckoning;
    }

    const int threads_;
    const std::string sensor_label_;
    StageTimes times_;
    Prepare prepare_;

    std::mutex reading_;  // guards all down to frames_read_
    const std::unique_ptr<ObservationSource> source_;
    DeadReckoner reckoner_;
    std::vector<mrpt::obs::CObservation::Ptr> before_;
    bool ended_ = false;
    std::deque<StreamedFrame> pending_;
    std::exception_ptr damage_;  // behind the pending frames
    CObservation3DRangeScan::Ptr first_;
    Camera camera_;
    std::size_t frames_read_ = 0;

    mutable std::mutex notes_access_;
    Trajectory truth_;
    SensorCensus census_;
    std::atomic<std::size_t> expected_frames_{0};

    BoundedQueue<std::future<StreamedFrame>> queue_;
    std::atomic<int> busy_workers_{0};
    std::vector<std::thread> workers_;
};

FrameStream::FrameStream(std::unique_ptr<ObservationSource> source, const ReadAhead& ahead,
                         const std::string& sensor_label)
    : impl_(std::make_unique<Implementation>(std::move(source), ahead, sensor_label)) {}

FrameStream::~FrameStream() = default;

const CObservation3DRangeScan& FrameStream::firstFrame() const {
    return impl_->firstFrame();
}

std::vector<CObservation3DRangeScan::Ptr> FrameStream::lookAhead(std::size_t frames) {
    return impl_->lookAhead(frames);
}

std::optional<StreamedFrame> FrameStream::skip() {
    return impl_->skip();
}

void FrameStream::start(Prepare prepare) {
    impl_->start(std::move(prepare));
}

std::optional<StreamedFrame> FrameStream::next() {
    return impl_->next();
}

void FrameStream::stop() {
    impl_->stop();
}

std::size_t FrameStream::expectedFrames() const {
    return impl_->expectedFrames();
}

Trajectory FrameStream::truth() const {
    return impl_->truth();
}

std::vector<SensorRecord> FrameStream::sensors() const {
    return impl_->sensors();
}

const StageTimes& FrameStream::times() const {
    return impl_->times();
}

}  // namespace rgbd_graphslam
