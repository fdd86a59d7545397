/** Import, SLAM and evaluation of one sequence. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/benchmark/sequence_result.h"
#include "rgbd_graphslam/benchmark/sequence_search.h"

namespace rgbd_graphslam {

/** Settings that all sequences of a benchmark share. */
struct SequenceRunOptions {
    /** Settings of rgbd-slam; empty: the shipped ones for the camera that the sequence's name
     *  tells, else default.ini. */
    std::string ini;
    /** `Section.key=value` over the ini. */
    std::vector<std::string> assignments;
    /** Dense maps and a picture of them. */
    bool maps = true;
    /** Keep the imported rawlog, which is as large as the images are raw. */
    bool keep_rawlog = false;
};

/** Text that changes with the recording, the settings and the programs. */
std::string fingerprintOf(const FoundSequence& sequence, const SequenceRunOptions& options);

/** Runs rgbd-import, rgbd-slam and rgbd-viewer as processes, evaluates the trajectory, and leaves
 * in `folder`: result.json, ate.png, view.png, run/ (the output of rgbd-slam) and what the
 * processes said. What goes wrong with the sequence is the result's `problem`, not an exception. */
SequenceResult runSequence(const FoundSequence& sequence, const SequenceRunOptions& options,
                           const std::string& folder);

}  // namespace rgbd_graphslam
