/** Numbers in texts. */
#pragma once
#include <cstdio>
#include <string>

namespace rgbd_graphslam {

/** As std::snprintf writes it; what is beyond 255 characters is cut off. */
template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof(text), format, values...);
    return text;
}

}  // namespace rgbd_graphslam
