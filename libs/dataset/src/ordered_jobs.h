/** Work on other threads whose results are taken in the order in which it was given. */
#pragma once
#include <deque>
#include <future>
#include <utility>

namespace rgbd_graphslam {

template <class Result>
class OrderedJobs {
  public:
    template <class Job>
    void push(Job job) {
        running_.push_back(std::async(std::launch::async, std::move(job)));
    }

    std::size_t size() const { return running_.size(); }

    /** Waits for the oldest job; what it threw is thrown here. */
    Result pop() {
        auto oldest = std::move(running_.front());
        running_.pop_front();
        return oldest.get();
    }

  private:
    std::deque<std::future<Result>> running_;
};

}  // namespace rgbd_graphslam
