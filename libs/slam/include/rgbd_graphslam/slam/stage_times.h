/** CPU and wall time of each stage, call by call. */
#pragma once
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "rgbd_graphslam/core/thread_clock.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {

/** Thread-safe: extraction runs ahead of tracking. */
class StageTimes {
  public:
    template <class Work>
    void measure(const std::string& stage, Work&& work) {
        const ThreadClock clock;
        work();
        add(stage, clock.cpuMs(), clock.wallMs());
    }

    void add(const std::string& stage, double cpu_ms, double wall_ms) {
        const std::lock_guard<std::mutex> lock(mutex_);
        auto& time = stages_[stage];
        time.stage = stage;
        time.cpu_ms.push_back(cpu_ms);
        time.wall_ms.push_back(wall_ms);
    }

    std::vector<VisualSlam::StageTime> all() const {
        const std::lock_guard<std::mutex> lock(mutex_);
        std::vector<VisualSlam::StageTime> times;
        for (const auto& [stage, time] : stages_) times.push_back(time);
        return times;
    }

  private:
    mutable std::mutex mutex_;
    std::map<std::string, VisualSlam::StageTime> stages_;
};

}  // namespace rgbd_graphslam
