/** Numbers as text that reads back to the same bits, and stamps to the microsecond. */
#pragma once
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>

namespace rgbd_graphslam {

/** The fewest digits that read back to the same number. */
template <class Real>
std::string shortest(Real value) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
    return std::string(text, end);
}

/** Seconds to the microsecond, as the TUM benchmark writes stamps. */
inline std::string stampText(double stamp_s) {
    char text[64];
    std::snprintf(text, sizeof(text), "%.6f", stamp_s);
    return text;
}

inline long long microseconds(double stamp_s) {
    return std::llround(stamp_s * 1e6);
}

}  // namespace rgbd_graphslam
