/** The files of a run. */
#pragma once
#include "run_state.h"

namespace rgbd_graphslam {

/** Writes the output folder as runSlamJob() says, and completes the report with what that took.
 *  \param run described
 *  \throws Error when nothing was mapped or located, or a file cannot be written */
void writeRun(RunState& run);

}  // namespace rgbd_graphslam
