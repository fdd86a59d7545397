#include "idle_time.h"

#include <unistd.h>

#include <fstream>
#include <string>
#include <utility>

namespace rgbd_graphslam {
namespace {

/** Of all processors since the machine began. */
double idleSeconds() {
    std::ifstream in("/proc/stat");
    std::string all_processors;
    double user = 0, nice = 0, system = 0, idle = 0, waiting = 0;  // in ticks
    in >> all_processors >> user >> nice >> system >> idle >> waiting;
    return (idle + waiting) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

}  // namespace

double IdleTime::processors(TimePoint now) {
    const double idle_s = idleSeconds();
    const double new_s = idle_s - std::exchange(idle_s_, idle_s);
    const std::chrono::duration<double> passed = now - std::exchange(read_, now);
    return passed.count() > 0 ? new_s / passed.count() : 0;
}

}  // namespace rgbd_graphslam
