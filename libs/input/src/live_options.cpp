#include "rgbd_graphslam/input/live_options.h"

namespace rgbd_graphslam {

void LiveOptions::describe(OptionVisitor& v) {
    v.integer("max_waiting_frames", max_waiting_frames, 1, 1000, "frames",
              "Frames per camera that may wait for tracking; beyond that the oldest is dropped");
    v.real("wait_ms", wait_ms, 0, 1000, "ms",
           "Longest time that a frame waits for readings of other sensors that are due before it");
    v.real("late_s", late_s, 0, 10, "s",
           "Readings older than the last frame by more than this are dropped");
    v.real("silence_s", silence_s, 0.1, 60, "s",
           "A sensor that sends nothing for this long, and for three of its periods, is reported");
}

}  // namespace rgbd_graphslam
