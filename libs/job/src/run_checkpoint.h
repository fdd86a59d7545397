/** A run's memory as a checkpoint keeps it. */
#pragma once
#include "checkpoint.h"
#include "run_state.h"

namespace rgbd_graphslam {

/** All that coming frames and the outputs depend on. Another layout of these bytes, or of what
 *  they are made of, needs another Checkpoint::format. */
std::string encodeRun(const RunState& run);

/** Takes up what encodeRun() wrote, and reads over the rawlog up to there.
 *  \param run fresh
 *  \throws Error as goOnFromCheckpoint() for the state */
void goOnFrom(const std::string& state, RunState& run);

void writeCheckpoint(const RunState& run, CheckpointWriter& writer);

/** Takes up what the checkpoint in the output folder knows, and reads over the rawlog up to there:
 *  other sensors and the keyframes' images are looked at again on the way.
 *  \param run fresh
 *  \throws Error as readCheckpoint() does, or when the rawlog ends before the checkpoint */
void goOnFromCheckpoint(RunState& run);

}  // namespace rgbd_graphslam
