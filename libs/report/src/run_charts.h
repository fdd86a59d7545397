/** Charts of a run, as SVG. Each is nothing where there is nothing to show. */
#pragma once
#include <string>

#include "rgbd_graphslam/metrics/ate.h"
#include "rgbd_graphslam/report/run_record.h"

namespace rgbd_graphslam {

/** Estimate and truth from above. */
std::string pathChart(const RunRecord& run);
/** Keyframes with and without loops from above, and the loops. */
std::string loopChart(const RunRecord& run);
/** Distance of each frame to its true place. */
std::string errorChart(const RunRecord& run, const AteResult& ate);
/** Landmarks of each frame, and where frames were lost. */
std::string landmarkChart(const RunRecord& run);

}  // namespace rgbd_graphslam
