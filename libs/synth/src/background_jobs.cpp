#include "background_jobs.h"

namespace rgbd_graphslam::synth {

BackgroundJobs::BackgroundJobs() : thread_([this] { run(); }) {}

BackgroundJobs::~BackgroundJobs() {
    queue_.close();
    if (thread_.joinable()) thread_.join();
}

void BackgroundJobs::add(std::function<void()> job) {
    rethrow();
    queue_.push(std::move(job));
}

void BackgroundJobs::finish() {
    queue_.close();
    if (thread_.joinable()) thread_.join();
    rethrow();
}

void BackgroundJobs::run() {
    while (auto job = queue_.pop()) {
        try {
            (*job)();
        } catch (...) {
            const std::lock_guard<std::mutex> lock(mutex_);
            if (!failure_) failure_ = std::current_exception();
        }
    }
}

void BackgroundJobs::rethrow() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
}

}  // namespace rgbd_graphslam::synth
