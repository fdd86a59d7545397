/** Wording that the checks of sensors share. */
#pragma once
#include <cmath>
#include <cstdio>
#include <string>

namespace rgbd_graphslam {

inline void addTo(std::string& findings, const std::string& finding) {
    findings += (findings.empty() ? "" : "; ") + finding;
}

/** With three digits. */
inline std::string factorText(double factor) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", factor);
    return std::abs(factor) >= 1000 ? std::to_string(std::lround(factor)) : text;
}

inline std::string delayText(double delay_s) {
    const long delay_ms = std::lround(1000 * std::abs(delay_s));
    return "its stamps are " + std::to_string(delay_ms) + " ms too " +
           (delay_s > 0 ? "late" : "early");
}

}  // namespace rgbd_graphslam
