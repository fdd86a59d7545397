/** What rgbd-benchmark does. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/benchmark/sequence_run.h"

namespace rgbd_graphslam {

/** What to run and where to put the results. */
struct BenchmarkRequest {
    std::vector<std::string> folders;
    std::string out_folder;
    /** Table of best published figures; empty: the shipped one. */
    std::string table;
    /** Sequences at a time; 0: as many as memory and processors allow. */
    int jobs = 0;
    Share share;
    SequenceRunOptions run;
};

/** Sequences that run at a time when nobody says: two processors and 2 GB of free memory each. */
int affordableJobs();

/** Runs all sequences of the share that have no up-to-date result yet, then writes the report over
 *  everything in the output folder.
 *  \return number of sequences of the share that failed
 *  \throws Error when nothing is found or the output folder cannot be written */
std::size_t runBenchmark(const BenchmarkRequest& request);

}  // namespace rgbd_graphslam
