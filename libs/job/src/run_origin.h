/** What was run, when and with which camera, for summary.json. */
#pragma once
#include <nlohmann/json.hpp>
#include <optional>

#include "rgbd_graphslam/geometry/camera.h"

namespace rgbd_graphslam {

/** {"command", "date", "camera"}: the command line as a shell takes it, the local time, and
 *  intrinsics, or null where they are not known. */
nlohmann::json originJson(const std::optional<Intrinsics>& camera);

}  // namespace rgbd_graphslam
