/** What a person should know about a run, in plain words. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/metrics/ate.h"
#include "rgbd_graphslam/report/run_record.h"

namespace rgbd_graphslam {

/** A sentence of the report. */
struct Finding {
    enum class Kind { Warning, Note } kind;
    std::string text;
};

/** Frames one after the other that have no pose. */
struct LostSpan {
    std::size_t frames = 0;
    double first_s = 0, last_s = 0;  // seconds since the first frame
    bool recovered = false;          // whether a frame after it has a pose
};

std::vector<LostSpan> lostSpans(const std::vector<ReportedFrame>& frames);

/** By how much depths are too large (0.035 = 3.5 %; negative: too small), as the path against its
 *  truth shows it. Nothing when another scale would not explain at least a quarter of the squared
 *  error, the scale is within 1 %, or moves poses by less than 5 mm: the error has other reasons
 *  then. */
std::optional<double> depthScaleError(const AteResult& ate);

/** The same in words, with the factor that mends it; empty where depthScaleError() is nothing. */
std::string depthScaleFinding(const AteResult& ate);

/** Warnings first. \param ate of the run against its truth, where that is known */
std::vector<Finding> findingsOf(const RunRecord& run, const std::optional<AteResult>& ate);

}  // namespace rgbd_graphslam
