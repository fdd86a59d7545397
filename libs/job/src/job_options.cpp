#include "rgbd_graphslam/job/job_options.h"

#include <cinttypes>
#include <cstdint>
#include <cstdio>

namespace rgbd_graphslam {

std::vector<Options*> JobOptions::all() {
    std::vector<Options*> structs{&run};
    const auto of_slam = slam.all();
    structs.insert(structs.end(), of_slam.begin(), of_slam.end());
    structs.push_back(&maps);
    structs.push_back(&laser);
    structs.push_back(&gps);
    structs.push_back(&live);
    structs.push_back(&semantics);
    return structs;
}

std::string configText(JobOptions options) {
    return toIniText(options.all());
}

std::string configHash(const JobOptions& options) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const unsigned char c : configText(options)) hash = (hash ^ c) * 0x100000001b3u;
    char digits[17];
    std::snprintf(digits, sizeof(digits), "%016" PRIx64, hash);
    return digits;
}

}  // namespace rgbd_graphslam
