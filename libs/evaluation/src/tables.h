/** The formats of a report, one function each. */
#pragma once
#include "rgbd_graphslam/evaluation/report.h"

namespace rgbd_graphslam {

std::string textTable(const std::vector<Report>& reports);
std::string csvTable(const std::vector<Report>& reports);
std::string jsonTable(const std::vector<Report>& reports);
std::string latexTable(const std::vector<Report>& reports);

}  // namespace rgbd_graphslam
