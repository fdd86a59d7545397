/** How much of the machine nobody uses. */
#pragma once
#include <chrono>

namespace rgbd_graphslam {

/** Reads /proc/stat. */
class IdleTime {
  public:
    using TimePoint = std::chrono::steady_clock::time_point;

    /** \return how many processors had nothing to do since the last call, on average; at first
     * since the machine began; 0 where the system does not tell */
    double processors(TimePoint now);

  private:
    double idle_s_ = 0;
    TimePoint read_;
};

}  // namespace rgbd_graphslam
