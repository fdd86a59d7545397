#include "rgbd_graphslam/job/run_options.h"

namespace rgbd_graphslam {

void RunOptions::describe(OptionVisitor& v) {
    v.integer("threads", threads, 1, 256, "",
              "Number of threads for tracking and read-ahead; results do not depend on it");
    v.integer("frames_ahead", frames_ahead, 1, 1000, "frames", "Size of the read-ahead queue");
    v.integer("max_frames", max_frames, 0, 1000000000, "frames",
              "Stop after this many frames (0 = no limit)");
    v.integer("max_keyframes", max_keyframes, 0, 1000000000, "keyframes",
              "Stop tracking and write the map at this many keyframes (0 = no limit)");
    v.integer("max_memory_mb", max_memory_mb, 0, 1000000000, "MB",
              "Stop tracking and write the map (which needs some more) at this memory use (0 = no "
              "limit)");
    v.integer(
        "checkpoint_keyframes", checkpoint_keyframes, 0, 1000000000, "keyframes",
        "Write a checkpoint for --resume after this many new keyframes (100 frames count as one) "
        "or a tenth of all (0 = never)");
    v.flag("dense_maps", dense_maps, "Build points, octree and grid after tracking");
}

}  // namespace rgbd_graphslam
