#include "rgbd_graphslam/graphslam/run_options.h"

namespace rgbd_graphslam {

void RunOptions::describe(OptionVisitor& v) {
    v.integer("threads", threads, 1, 256, "",
              "Threads of tracking and reading ahead; the result does not depend on it");
    v.integer("frames_ahead", frames_ahead, 1, 1000, "frames",
              "Most frames that are read before tracking gets to them");
    v.integer("max_frames", max_frames, 0, 1000000000, "frames", "Stop after as many; 0 = never");
    v.integer("max_keyframes", max_keyframes, 0, 1000000000, "keyframes",
              "Stop tracking with as many and write the map; 0 = never");
    v.integer("max_memory_mb", max_memory_mb, 0, 1000000000, "MB",
              "Stop tracking at as much and write the map, which takes some more; 0 = never");
    v.integer(
        "checkpoint_keyframes", checkpoint_keyframes, 0, 1000000000, "keyframes",
        "Write a checkpoint for --resume after as many new ones (100 frames count as one) or a "
        "tenth of all; 0 = never");
    v.flag("dense_maps", dense_maps, "Build points, octree and grid after tracking");
}

}  // namespace rgbd_graphslam
