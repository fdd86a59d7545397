/** Tables of a run, as HTML. Each is nothing where there is nothing to show. */
#pragma once
#include <string>

#include "rgbd_graphslam/report/run_record.h"

namespace rgbd_graphslam {

/** A figure without decimals that say nothing: 0.42, 7.3, 118. */
std::string figureText(double value);

/** Recording, command, date, settings and camera. */
std::string aboutTable(const RunRecord& run);

/** The loops with the largest errors, or the first ones where the truth is not known. */
std::string loopTable(const RunRecord& run);

/** What the loops' errors come to, in a sentence of plain text. */
std::string loopSummary(const RunRecord& run);

/** CPU time by stage, its share of all of it, and a bar as long. */
std::string stageTable(const RunRecord& run);

/** What each sensor gave; nothing where it was not measured. */
std::string sensorTable(const RunRecord& run);

}  // namespace rgbd_graphslam
