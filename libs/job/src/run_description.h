/** The figures of a run that is done tracking. */
#pragma once
#include "run_state.h"

namespace rgbd_graphslam {

/** Chooses the submap that is written and fills the report and the truth beside it:
 * counts, loops, errors against the ground truth, times of stages. Warns of frames that no loop has
 * joined with the rest. */
void describeRun(RunState& run);

}  // namespace rgbd_graphslam
