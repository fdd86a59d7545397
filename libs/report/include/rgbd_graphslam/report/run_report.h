/** A run as one page that opens from disk in any browser. */
#pragma once
#include <string>

#include "rgbd_graphslam/report/run_record.h"

namespace rgbd_graphslam {

/** The page: needs no network and no other file. */
std::string runReportHtml(const RunRecord& run);

/** Writes report.html into map_folder, of the files in both folders (which may be the same), and
 *  where loops were closed loops.svg, its picture of them.
 *  \throws Error as readRunRecord does, or when the page cannot be written */
void writeRunReport(const std::string& run_folder, const std::string& map_folder);

}  // namespace rgbd_graphslam
