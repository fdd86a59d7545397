/** One report over many sequences. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/benchmark/sequence_result.h"
#include "rgbd_graphslam/benchmark/sequence_table.h"

namespace rgbd_graphslam {

/** Writes report.md and report.html over all results in the folders `folder`/NAME, whoever made
 *  them; the pictures are inside the HTML file, which needs no network.
 *  \param table best published figures
 *  \return the results, sorted by name
 *  \throws Error when there is no result or a file cannot be written */
std::vector<SequenceResult> writeReport(const std::string& folder,
                                        const std::vector<KnownSequence>& table);

}  // namespace rgbd_graphslam
