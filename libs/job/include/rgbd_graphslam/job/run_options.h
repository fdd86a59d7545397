/** Settings of a whole run. */
#pragma once
#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {

/** Section `[RunOptions]`. */
struct RunOptions : Options {
    int threads = 2;
    int frames_ahead = 8;
    int max_frames = 0;
    int max_keyframes = 0;
    int max_memory_mb = 0;
    int checkpoint_keyframes = 50;
    bool dense_maps = true;

    const char* section() const override { return "RunOptions"; }
    const char* about() const override { return "Threads, limits and outputs of a run"; }
    void describe(OptionVisitor& v) override;
};

}  // namespace rgbd_graphslam
