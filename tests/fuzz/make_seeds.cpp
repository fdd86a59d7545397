/** make_seeds FOLDER: writes the corpora of the targets whose files are not text. */
#include <cstdio>

#include "../support/tum_folder.h"
#include "fuzz_targets.h"

int main(int argc, char** argv) {
    using namespace rgbd_graphslam;
    if (argc != 2) {
        std::fputs("usage: make_seeds FOLDER\n", stderr);
        return 2;
    }
    for (const std::string target :
         {"rawlog", "sparse_map", "checkpoint", "binary_octree", "color_octree", "ros1_bag", "mcap",
          "ros2_database", "ros_messages", "compressed_depth", "sens"}) {
        const std::filesystem::path folder = std::filesystem::path(argv[1]) / target;
        std::filesystem::create_directories(folder);
        int number = 0;
        for (const std::string& seed : binarySeeds(target)) {
            std::ofstream(folder / ("seed" + std::to_string(++number)), std::ios::binary) << seed;
        }
    }
    return 0;
}
