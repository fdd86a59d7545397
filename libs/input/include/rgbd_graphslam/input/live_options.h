/** Settings of runs over sensors that are read live. */
#pragma once
#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {

/** Section `[LiveOptions]`. */
struct LiveOptions : Options {
    int max_waiting_frames = 2;
    double wait_ms = 5;
    double late_s = 0.2;
    double silence_s = 0.8;

    const char* section() const override { return "LiveOptions"; }
    const char* about() const override { return "Live sensors (rgbd-slam --live)"; }
    void describe(OptionVisitor& v) override;
};

}  // namespace rgbd_graphslam
