/** The popcount instruction is younger than the x86-64 baseline that Debian builds for: functions
 *  marked with this exist twice, and the machine takes the one it can run. */
#pragma once
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RGBD_WITH_POPCOUNT __attribute__((target_clones("popcnt", "default")))
#else
#define RGBD_WITH_POPCOUNT
#endif
