/** What the process has used so far. */
#pragma once
#include <sys/resource.h>

namespace rgbd_graphslam {

inline rusage processUsage() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage;
}

/** User and system time of all threads. */
inline double processCpuSeconds() {
    const rusage usage = processUsage();
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

inline double peakMemoryMb() {
    return static_cast<double>(processUsage().ru_maxrss) / 1024;
}

}  // namespace rgbd_graphslam
