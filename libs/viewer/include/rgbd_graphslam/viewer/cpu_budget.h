/** How often a program may draw that is to leave the processor to others. */
#pragma once
#include <algorithm>
#include <chrono>

namespace rgbd_graphslam {

/** Rests after each stretch of work until what it took is no more than a share of one processor. */
class CpuBudget {
  public:
    using TimePoint = std::chrono::steady_clock::time_point;

    /** \param share of one processor's time, above 0
     *  \param cpu_s what the process has taken before it keeps to the share */
    CpuBudget(double share, double cpu_s) : share_(share), cpu_s_(cpu_s) {}

    /** From the next stretch of work on. \param share of one processor's time, above 0 */
    void setShare(double share) { share_ = share; }
    /** After a stretch of work.
     *  \param cpu_s what the process has taken since it began, all threads together */
    void spent(TimePoint now, double cpu_s) {
        const std::chrono::duration<double> rest((cpu_s - cpu_s_) / share_);
        next_ = now + std::chrono::duration_cast<TimePoint::duration>(rest);
        cpu_s_ = cpu_s;
    }
    /** Whether all that was spent has been made up for. */
    bool allows(TimePoint now) const { return now >= next_; }
    /** How long that takes yet, s; negative when it is over. */
    double rest(TimePoint now) const { return std::chrono::duration<double>(next_ - now).count(); }

  private:
    double share_, cpu_s_;
    TimePoint next_;
};

/** What a program beside a running SLAM may take.
 *  \param idle processors that had nothing to do of late, e.g. 1.5
 *  \return share of one processor: a part of what is idle, and next to nothing where nothing is */
inline double shareBesideSlam(double idle) {
    constexpr double least = 0.015, most = 0.25, left_alone = 0.5, part = 0.25;
    return std::clamp(part * (idle - left_alone), least, most);
}

}  // namespace rgbd_graphslam
