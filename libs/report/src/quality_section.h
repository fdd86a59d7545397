/** What a run's own data say of its quality, where no ground truth is known. */
#pragma once
#include <string>

#include "rgbd_graphslam/report/run_record.h"

namespace rgbd_graphslam {

/** A table and a note, as HTML; empty for runs of earlier versions, which say nothing of it. */
std::string qualitySection(const RunRecord& run);

}  // namespace rgbd_graphslam
