/** What a run found out about its inertial sensor and wheels. */
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "rgbd_graphslam/report/run_record.h"

namespace rgbd_graphslam {

/** \param motion of summary.json, or null */
std::vector<MotionFigure> motionFigures(const nlohmann::json& motion);

/** A table; empty where nothing is known. */
std::string motionSection(const RunRecord& run);

}  // namespace rgbd_graphslam
