/** Hand-over between the stages of a pipeline. */
#pragma once
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

namespace rgbd_graphslam {

/** First-in first-out queue of limited length: a fast producer waits (back-pressure) and neither
 *  side spins. Closing it lets the consumer drain what is left. */
template <class T>
class BoundedQueue {
  public:
    explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

    /** Waits for room. \return false when the queue was closed, the item is dropped then */
    bool push(T item) {
        std::unique_lock<std::mutex> lock(mutex_);
        room_.wait(lock, [&] { return closed_ || items_.size() < capacity_; });
        if (closed_) return false;
        items_.push_back(std::move(item));
        filled_.notify_one();
        return true;
    }

    /** Waits for an item. \return nothing when the queue is closed and empty */
    std::optional<T> pop() {
        std::unique_lock<std::mutex> lock(mutex_);
        filled_.wait(lock, [&] { return closed_ || !items_.empty(); });
        if (items_.empty()) return std::nullopt;
        std::optional<T> item(std::move(items_.front()));
        items_.pop_front();
        room_.notify_one();
        return item;
    }

    void close() {
        const std::lock_guard<std::mutex> lock(mutex_);
        closed_ = true;
        filled_.notify_all();
        room_.notify_all();
    }

  private:
    const std::size_t capacity_;
    std::deque<T> items_;
    bool closed_ = false;
    std::mutex mutex_;
    std::condition_variable filled_, room_;
};

}  // namespace rgbd_graphslam
