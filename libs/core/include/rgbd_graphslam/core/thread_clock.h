/** What a stretch of work costs the thread that does it. */
#pragma once
#include <chrono>
#include <ctime>

namespace rgbd_graphslam {

/** Measures from its construction; for the calling thread only. */
class ThreadClock {
  public:
    double cpuMs() const { return cpuNow() - cpu_; }
    double wallMs() const { return wallNow() - wall_; }

  private:
    static double cpuNow() {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return 1e3 * t.tv_sec + 1e-6 * t.tv_nsec;
    }
    static double wallNow() {
        return std::chrono::duration<double, std::milli>(
                   std::chrono::steady_clock::now().time_since_epoch())
            .count();
    }
    double cpu_ = cpuNow();
    double wall_ = wallNow();
};

}  // namespace rgbd_graphslam
