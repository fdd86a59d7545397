/** Puts finished frames on disk in the background. */
#pragma once
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "rgbd_graphslam/core/bounded_queue.h"

namespace rgbd_graphslam::synth {

/** Runs jobs in order on one thread of its own; what a job throws comes out of the next call. */
class BackgroundJobs {
  public:
    BackgroundJobs();
    ~BackgroundJobs();
    /** Waits while many jobs are waiting already. */
    void add(std::function<void()> job);
    /** Waits for all jobs. */
    void finish();

  private:
    void run();
    void rethrow();

    BoundedQueue<std::function<void()>> queue_{6};
    std::mutex mutex_;
    std::exception_ptr failure_;
    std::thread thread_;
};

}  // namespace rgbd_graphslam::synth
