#include "rgbd_graphslam/graphslam/frame_stream.h"

#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "dead_reckoner.h"
#include "rgbd_graphslam/core/bounded_queue.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation3DRangeScan;

namespace {

void checkSize(const RgbdImage& image, const CObservation3DRangeScan& first, std::size_t index) {
    const Camera camera = toCamera(first.cameraParamsIntensity);
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
    Implementation(const std::string& rawlog, const RunOptions& options)
        : options_(options),
          reader_(rawlog),
          queue_(static_cast<std::size_t>(options.frames_ahead)) {
        pending_ = readFrame();
        if (!pending_) {
            throw Error("the rawlog '" + rawlog + "' has no RGB-D frame (CObservation3DRangeScan)",
                        "import a sequence with rgbd-import");
        }
    }

    ~Implementation() { stop(); }

    std::optional<StreamedFrame> skip() { return takeFrame(); }

    void start(Prepare prepare) {
        prepare_ = std::move(prepare);
        busy_workers_ = options_.threads - 1;
        for (int i = 0; i < options_.threads - 1; ++i) workers_.emplace_back([this] { work(); });
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
        const std::lock_guard<std::mutex> lock(truth_access_);
        return truth_;
    }

  private:
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
        if (pending_) return std::exchange(pending_, std::nullopt);
        std::optional<StreamedFrame> frame;
        times_.measure("read", [&] { frame = readFrame(); });
        return frame;
    }

    std::optional<StreamedFrame> readFrame() {
        if (ended_) return std::nullopt;
        ended_ = true;  // for good, should reading throw
        while (const auto observation = reader_.next()) {
            noteTruth(*observation);
            reckoner_.note(*observation);
            auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
            if (!frame) {
                before_.push_back(observation);
                continue;
            }
            if (!first_) first_ = frame;
            if (frame->sensorLabel != first_->sensorLabel) continue;  // another camera
            ended_ = false;
            const std::size_t index = frames_read_++;
            checkStamp(*frame, index);
            expected_frames_ = std::lround(frames_read_ / std::max(1e-9, reader_.progress()));
            const DeadReckoning reckoning =
                reckoner_.at(toSeconds(frame->timestamp), cameraOnRobot(*first_));
            return StreamedFrame{
                std::exchange(before_, {}), index, std::move(frame), {}, reckoning};
        }
        return std::nullopt;
    }

    void noteTruth(const mrpt::obs::CObservation& observation) {
        const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation);
        if (!pose || pose->sensorLabel != ground_truth_label) return;
        const SE3 T_truth_robot = toSE3(pose->pose.mean);
        if (!T_truth_robot.R.allFinite() || !T_truth_robot.t.allFinite()) return;
        const std::lock_guard<std::mutex> lock(truth_access_);
        truth_.push_back({toSeconds(pose->timestamp), T_truth_robot});
    }

    void prepare(StreamedFrame& frame) {
        RgbdImage image;
        times_.measure("decode", [&] { image = toRgbdImage(frame.observation); });
        checkSize(image, *first_, frame.index);
        frame.prepared = prepare_(image);
        frame.prepared.reckoning = frame.reckoning;
    }

    const RunOptions options_;
    StageTimes times_;
    Prepare prepare_;

    std::mutex reading_;  // guards all down to frames_read_
    RawlogReader reader_;
    DeadReckoner reckoner_;
    std::vector<mrpt::obs::CObservation::Ptr> before_;
    bool ended_ = false;
    std::optional<StreamedFrame> pending_;
    CObservation3DRangeScan::Ptr first_;
    std::size_t frames_read_ = 0;

    mutable std::mutex truth_access_;
    Trajectory truth_;
    std::atomic<std::size_t> expected_frames_{0};

    BoundedQueue<std::future<StreamedFrame>> queue_;
    std::atomic<int> busy_workers_{0};
    std::vector<std::thread> workers_;
};

FrameStream::FrameStream(const std::string& rawlog, const RunOptions& options)
    : impl_(std::make_unique<Implementation>(rawlog, options)) {}

FrameStream::~FrameStream() = default;

const CObservation3DRangeScan& FrameStream::firstFrame() const {
    return impl_->firstFrame();
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

const StageTimes& FrameStream::times() const {
    return impl_->times();
}

}  // namespace rgbd_graphslam
