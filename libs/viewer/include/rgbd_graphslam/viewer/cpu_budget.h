/** How often a program may draw that is to leave the processor to others. */
#pragma once
#include <chrono>

namespace rgbd_graphslam {

/** Rests after each stretch of work until what it took is no more than a share of one processor. */
class CpuBudget {
  public:
    using TimePoint = std::chrono::steady_clock::time_point;

    /** \param share of one processor's time, above 0
     *  \param cpu_s what the process has taken before it keeps to the share */
    CpuBudget(double share, double cpu_s) : share_(share), cpu_s_(cpu_s) {}

    /** After a stretch of work.
     *  \param cpu_s what the process has taken since it began, all threads together */
    void spent(TimePoint now, double cpu_s) {
        const std::chrono::duration<double> rest((cpu_s - cpu_s_) / share_);
        next_ = now + std::chrono::duration_cast<TimePoint::duration>(rest);
        cpu_s_ = cpu_s;
    }
    /** Whether all that was spent has been made up for. */
    bool allows(TimePoint now) const { return now >= next_; }

  private:
    double share_, cpu_s_;
    TimePoint next_;
};

}  // namespace rgbd_graphslam
