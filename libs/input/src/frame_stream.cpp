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
#include "motion_readings_collector.h"
#include "rgbd_graphslam/core/bounded_queue.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/stereo_frame.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation3DRangeScan;

namespace {

void checkSize(const RgbdImage& image, const Camera& camera, std::size_t index) {
    if (image.gray.cols == camera.width && image.gray.rows == camera.height) return;
    throw Error("frame " + std::to_string(index) + " is " + std::to_string(image.gray.cols) + "x" +
                    std::to_string(image.gray.rows) + " pixels, its camera's calibration is for " +
                    std::to_string(camera.width) + "x" + std::to_string(camera.height),
                "import the sequence with the calibration of its camera");
}

bool isImage(const mrpt::obs::CObservation& observation) {
    return dynamic_cast<const CObservation3DRangeScan*>(&observation) ||
           dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation);
}

void checkStamp(const CObservation3DRangeScan& frame, std::size_t index) {
    if (frame.timestamp != INVALID_TIMESTAMP) return;
    throw Error("frame " + std::to_string(index) + " of the rawlog has no timestamp",
                "export it with 'rawlog2tum RAWLOG DIR --rate HZ', which stamps such frames by "
                "their number, and import DIR with rgbd-import");
}

std::vector<CObservation3DRangeScan::Ptr> imagesOf(const StreamedFrame& frame) {
    std::vector<CObservation3DRangeScan::Ptr> images{frame.observation};
    for (const auto& [camera, observation] : frame.others) images.push_back(observation);
    return images;
}

}  // namespace

class FrameStream::Implementation {
  public:
    Implementation(std::shared_ptr<ObservationSource> source, const ReadAhead& ahead,
                   const std::string& sensor_label)
        : threads_(ahead.threads),
          sensor_label_(sensor_label),
          source_(std::move(source)),
          queue_(static_cast<std::size_t>(ahead.frames)) {
        findRig();
        auto frame = readFrame();
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

    void notePose(const StreamedFrame& frame) {
        for (const auto& image : imagesOf(frame)) {
            source_->notePose(image->sensorLabel, image->timestamp);
        }
    }
    void noteTracked(const StreamedFrame& frame) {
        for (const auto& image : imagesOf(frame)) {
            source_->noteTracked(image->sensorLabel, image->timestamp);
        }
    }

    std::size_t surveyFrames(std::size_t usual) const { return source_->surveyFrames(usual); }
    const Rig& rig() const { return rig_; }
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
            throw Error(source_->name() +
                            " has no RGB-D frame (CObservation3DRangeScan) and no stereo pair" +
                            holds,
                        source_->cameraRemedy());
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

    /** Observations of one moment. */
    std::optional<StreamedFrame> readFrame() {
        auto frame = nextObservation();
        if (!frame) return frame;
        frame->index = frames_read_++;
        if (rig_.cameras.size() == 1) return frame;
        while (frame->others.size() + 1 < rig_.cameras.size()) {
            auto* const other = peek();
            if (!other || !isOfSameMoment(*frame, *other)) break;
            add(std::move(*other), *frame);
            read_.pop_front();
        }
        return frame;
    }

    static bool isOfSameMoment(const StreamedFrame& frame, const StreamedFrame& other) {
        if (other.observation->timestamp == INVALID_TIMESTAMP || frame.camera == other.camera)
            return false;
        for (const auto& [camera, observation] : frame.others) {
            if (camera == other.camera) return false;
        }
        const double apart_s =
            toSeconds(other.observation->timestamp) - toSeconds(frame.observation->timestamp);
        return std::abs(apart_s) <= same_moment_s;
    }

    /** The frame is where its first observation was; what lies between the two comes before it. */
    static void add(StreamedFrame other, StreamedFrame& frame) {
        const auto append = [](const auto& more, auto& list) {
            list.insert(list.end(), more.begin(), more.end());
        };
        append(other.before, frame.before);
        append(other.readings.imu, frame.readings.imu);
        append(other.readings.wheels, frame.readings.wheels);
        if (other.camera < frame.camera) {
            std::swap(frame.observation, other.observation);
            std::swap(frame.camera, other.camera);
            std::swap(frame.entry, other.entry);
        }
        frame.others.emplace_back(other.camera, std::move(other.observation));
        std::sort(frame.others.begin(), frame.others.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
    }

    /** The next observation, which stays; null at the end and before damage. */
    StreamedFrame* peek() {
        if (read_.empty()) {
            try {
                if (auto next = readObservation()) read_.push_back(std::move(*next));
            } catch (...) {
                damage_behind_ = std::current_exception();
            }
        }
        return read_.empty() ? nullptr : &read_.front();
    }

    std::optional<StreamedFrame> nextObservation() {
        if (read_.empty()) {
            if (damage_behind_) std::rethrow_exception(std::exchange(damage_behind_, nullptr));
            return readObservation();
        }
        std::optional<StreamedFrame> next = std::move(read_.front());
        read_.pop_front();
        return next;
    }

    /** Reads ahead until the first camera has taken a few frames. */
    void findRig() {
        constexpr int frames_of_first = 4;
        auto first = readObservation();
        if (!first) refuse();
        read_.push_back(std::move(*first));
        int taken = 1;
        try {
            while (taken < frames_of_first) {
                auto next = readObservation();
                if (!next) break;
                taken += next->camera == 0;
                read_.push_back(std::move(*next));
            }
        } catch (...) {
            damage_behind_ = std::current_exception();
        }
        rig_is_known_ = true;
        while (const auto same = rig_.coincident()) leaveOut(same->first, same->second);
    }

    void leaveOut(const std::string& kept, const std::string& label) {
        sayWarning("the RGB-D cameras '" + kept + "' and '" + label +
                   "' have the same pose on the robot, which cannot be right: '" + label +
                   "' is left out; correct its sensor pose, or choose one with --sensor");
        const int gone = *rig_.find(label);
        rig_.cameras.erase(rig_.cameras.begin() + gone);
        std::vector<mrpt::obs::CObservation::Ptr> before;
        std::deque<StreamedFrame> kept_frames;
        for (StreamedFrame& frame : read_) {
            before.insert(before.end(), frame.before.begin(), frame.before.end());
            if (frame.camera == gone) continue;
            frame.camera -= frame.camera > gone;
            frame.before = std::exchange(before, {});
            kept_frames.push_back(std::move(frame));
        }
        before_.insert(before_.begin(), before.begin(), before.end());
        read_ = std::move(kept_frames);
        const std::lock_guard<std::mutex> lock(notes_access_);
        census_.leaveOut(label);
    }

    /** The next observation of a camera of the rig. */
    std::optional<StreamedFrame> readObservation() {
        if (ended_) return std::nullopt;
        ended_ = true;  // for good, should reading throw
        while (const auto observation = source_->next()) {
            const std::size_t entry = entries_read_++;
            auto frame = asRgbdFrame(observation);
            if (frame) takeIntoRig(frame);
            note(*observation);
            if (!frame) {
                before_.push_back(observation);
                continue;
            }
            const auto camera = rig_.find(frame->sensorLabel);
            if (!camera) continue;  // another camera, which the sensors' list tells
            ended_ = false;
            const std::size_t index = frames_read_ + read_.size();
            checkStamp(*frame, index);
            expected_frames_ =
                std::lround((index + 1) / std::max(1e-9, source_->progress().value_or(1)) /
                            static_cast<double>(rig_.cameras.size()));
            StreamedFrame read;
            read.before = std::exchange(before_, {});
            read.index = index;
            read.entry = entry;
            read.reckoning = reckoner_.at(toSeconds(frame->timestamp), cameraOnRobot(*first_));
            read.readings = readings_.take(cameraOnRobot(*first_));
            read.observation = std::move(frame);
            read.camera = *camera;
            return read;
        }
        return std::nullopt;
    }

    /** The first frame wanted is the first camera's; others belong to it from the beginning. */
    void takeIntoRig(const CObservation3DRangeScan::Ptr& frame) {
        if (rig_is_known_ || rig_.find(frame->sensorLabel)) return;
        const bool wanted = sensor_label_.empty() || frame->sensorLabel == sensor_label_;
        const bool has_images = frame->hasIntensityImage && frame->hasRangeImage;
        if (!wanted || (first_ && !has_images)) return;
        rig_.cameras.push_back(rigCameraOf(*frame));
        if (!first_) first_ = frame;
    }

    void note(const mrpt::obs::CObservation& observation) {
        reckoner_.note(observation);
        readings_.note(observation);
        const std::lock_guard<std::mutex> lock(notes_access_);
        noteTruth(observation);
        census_.note(observation, isUsed(observation));
    }

    /** Wheels, IMU, truth, the stamps in comments, and the frames themselves. */
    bool isUsed(const mrpt::obs::CObservation& observation) const {
        using namespace mrpt::obs;
        if (isImage(observation)) return rig_.find(observation.sensorLabel).has_value();
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

    RgbdImage decoded(const CObservation3DRangeScan::Ptr& observation) {
        RgbdImage image;
        times_.measure("decode", [&] { image = toTrackingImage(observation); });
        return image;
    }

    void prepare(StreamedFrame& frame) {
        std::vector<CameraImage> images = {{frame.camera, decoded(frame.observation)}};
        for (const auto& [camera, observation] : frame.others) {
            images.push_back({camera, decoded(observation)});
        }
        for (const CameraImage& image : images) {
            checkSize(image.image, rig_.cameras[image.camera].model, frame.index);
        }
        frame.prepared = prepare_(images);
        frame.prepared.reckoning = frame.reckoning;
        frame.prepared.readings = std::move(frame.readings);
    }

    const int threads_;
    const std::string sensor_label_;
    StageTimes times_;
    Prepare prepare_;

    std::mutex reading_;  // guards all down to frames_read_
    const std::shared_ptr<ObservationSource> source_;
    DeadReckoner reckoner_;
    MotionReadingsCollector readings_;
    std::vector<mrpt::obs::CObservation::Ptr> before_;
    bool ended_ = false;
    std::deque<StreamedFrame> pending_;
    std::exception_ptr damage_;  // behind the pending frames
    CObservation3DRangeScan::Ptr first_;
    std::size_t frames_read_ = 0, entries_read_ = 0;

    std::deque<StreamedFrame> read_;    // one observation each
    std::exception_ptr damage_behind_;  // the observations read
    Rig rig_;
    bool rig_is_known_ = false;

    mutable std::mutex notes_access_;
    Trajectory truth_;
    SensorCensus census_;
    std::atomic<std::size_t> expected_frames_{0};

    BoundedQueue<std::future<StreamedFrame>> queue_;
    std::atomic<int> busy_workers_{0};
    std::vector<std::thread> workers_;
};

FrameStream::FrameStream(std::shared_ptr<ObservationSource> source, const ReadAhead& ahead,
                         const std::string& sensor_label)
    : impl_(std::make_unique<Implementation>(std::move(source), ahead, sensor_label)) {}

FrameStream::~FrameStream() = default;

const Rig& FrameStream::rig() const {
    return impl_->rig();
}

const CObservation3DRangeScan& FrameStream::firstFrame() const {
    return impl_->firstFrame();
}

std::vector<CObservation3DRangeScan::Ptr> FrameStream::lookAhead(std::size_t frames) {
    return impl_->lookAhead(frames);
}

std::size_t FrameStream::surveyFrames(std::size_t usual) const {
    return impl_->surveyFrames(usual);
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

void FrameStream::notePose(const StreamedFrame& frame) {
    impl_->notePose(frame);
}

void FrameStream::noteTracked(const StreamedFrame& frame) {
    impl_->noteTracked(frame);
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
