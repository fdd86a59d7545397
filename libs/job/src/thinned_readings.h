/** Readings of a long run in bounded memory. */
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Keeps blocks of ten seconds: all of them at first, then every second, every fourth, ... */
class ThinnedReadings {
  public:
    void add(const StampedVector& reading) {
        if (kept_.empty()) first_s_ = reading.stamp_s;
        last_s_ = reading.stamp_s;
        const long long block = blockOf(reading);
        if (block % step_ != 0) return;
        kept_.push_back(reading);
        while (block / step_ >= most_blocks) thin();
    }

    const std::vector<StampedVector>& kept() const { return kept_; }
    /** Of all readings, kept or not. */
    double firstStamp() const { return first_s_; }
    double lastStamp() const { return last_s_; }

  private:
    static constexpr double block_s = 10;
    static constexpr long long most_blocks = 64, last_block = 1LL << 40;

    long long blockOf(const StampedVector& reading) const {
        return static_cast<long long>(
            std::clamp((reading.stamp_s - first_s_) / block_s, 0.0, double(last_block)));
    }

    void thin() {
        step_ *= 2;
        const auto skipped = [&](const auto& reading) { return blockOf(reading) % step_ != 0; };
        kept_.erase(std::remove_if(kept_.begin(), kept_.end(), skipped), kept_.end());
    }

    std::vector<StampedVector> kept_;
    double first_s_ = 0, last_s_ = 0;
    long long step_ = 1;
};

}  // namespace rgbd_graphslam
