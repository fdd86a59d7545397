#include "rgbd_graphslam/graphslam/live_slam.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
using FramePtr = mrpt::obs::CObservation3DRangeScan::Ptr;

class LiveSlam::Implementation {
  public:
    Implementation(GraphSlamSession& session, LiveSlamCallbacks callbacks)
        : session_(session), callbacks_(std::move(callbacks)), thread_([this] { run(); }) {}
    ~Implementation() {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            waiting_.clear();
        }
        end();
    }

    bool push(FramePtr frame) {
        const std::lock_guard<std::mutex> lock(mutex_);
        const bool full = waiting_.size() >= max_waiting;
        if (full) {
            waiting_.pop_front();
            ++dropped_;
        }
        waiting_.push_back(std::move(frame));
        changed_.notify_one();
        return !full;
    }

    void finish() {
        end();
        if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
        session_.finish();
    }

    std::size_t dropped() const {
        const std::lock_guard<std::mutex> lock(mutex_);
        return dropped_;
    }

  private:
    void end() {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            closed_ = true;
            changed_.notify_one();
        }
        if (thread_.joinable()) thread_.join();
    }

    /** \return nothing at the end */
    FramePtr next() {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
        if (waiting_.empty()) return {};
        FramePtr frame = std::move(waiting_.front());
        waiting_.pop_front();
        return frame;
    }

    void run() {
        try {
            while (const FramePtr frame = next()) trackOne(frame);
        } catch (...) {
            failure_ = std::current_exception();
        }
    }

    void trackOne(const FramePtr& frame) {
        TrackedFrame tracked;
        try {
            tracked = session_.step(frame);
        } catch (const Error& problem) {
            if (callbacks_.on_unusable) callbacks_.on_unusable(problem.what());
            return;
        }
        report(tracked);
    }

    void report(const TrackedFrame& tracked) const {
        if (callbacks_.on_frame) callbacks_.on_frame(tracked);
        if (!tracked.keyframe) return;
        if (callbacks_.on_keyframe) callbacks_.on_keyframe(tracked);
        if (!callbacks_.on_loop) return;
        for (const PoseEdge& loop : session_.slam().loops()) {
            if (loop.to == *tracked.keyframe) callbacks_.on_loop(loop);
        }
    }

    GraphSlamSession& session_;
    const LiveSlamCallbacks callbacks_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<FramePtr> waiting_;
    std::size_t dropped_ = 0;
    bool closed_ = false;
    std::exception_ptr failure_;  // written by the thread, read once it has ended
    std::thread thread_;          // last, so that all else is there when it starts
};

LiveSlam::LiveSlam(GraphSlamSession& session, LiveSlamCallbacks callbacks)
    : impl_(std::make_unique<Implementation>(session, std::move(callbacks))) {}

LiveSlam::~LiveSlam() = default;

bool LiveSlam::push(FramePtr frame) {
    return impl_->push(std::move(frame));
}

void LiveSlam::finish() {
    impl_->finish();
}

std::size_t LiveSlam::dropped() const {
    return impl_->dropped();
}

}  // namespace rgbd_graphslam
