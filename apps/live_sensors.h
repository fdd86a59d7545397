/** The sensors of --live, in a module that is loaded when it is needed. */
#pragma once
#include <memory>
#include <string>

#include "rgbd_graphslam/input/live_source.h"

namespace rgbd_graphslam {

/** \return the running sensors, which stop when it goes
 *  \throws Error naming file, section and what is wrong, or the module that is missing */
std::shared_ptr<void> startLiveSensors(const std::string& ini,
                                       const std::shared_ptr<LiveSource>& source);

}  // namespace rgbd_graphslam
