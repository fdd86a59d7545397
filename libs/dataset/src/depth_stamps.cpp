#include "rgbd_graphslam/dataset/depth_stamps.h"

#include <cmath>
#include <cstdio>
#include <sstream>

namespace rgbd_graphslam {
namespace {

constexpr const char* header = "[depth_stamps]";
constexpr long long million = 1000000;

}  // namespace

std::string toIniText(const DepthStamps& stamps) {
    if (stamps.empty()) return "";
    std::string text = std::string(header) +
                       "\n; stamp of a frame (its color image) = stamp of its depth image, UNIX "
                       "time in s; equal where not listed\n";
    char line[128];
    for (const auto& [color_us, depth_us] : stamps) {
        std::snprintf(line, sizeof(line), "%lld.%06lld = %lld.%06lld\n", color_us / million,
                      color_us % million, depth_us / million, depth_us % million);
        text += line;
    }
    return text;
}

DepthStamps depthStampsIn(const std::string& comment) {
    DepthStamps stamps;
    std::istringstream in(comment);
    bool inside = false;
    for (std::string line; std::getline(in, line);) {
        if (!line.empty() && line[0] == '[') inside = line.rfind(header, 0) == 0;
        double color_s = 0, depth_s = 0;
        if (!inside || std::sscanf(line.c_str(), "%lf = %lf", &color_s, &depth_s) != 2) continue;
        stamps[std::llround(color_s * million)] = std::llround(depth_s * million);
    }
    return stamps;
}

}  // namespace rgbd_graphslam
