/** The RGB-D cameras of a rawlog. */
#pragma once
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rgbd_graphslam {

struct SurveyedCamera {
    std::string label;
    std::size_t frames = 0, stamped = 0;
};

struct CameraSurvey {
    /** In order of their first frames. */
    std::vector<SurveyedCamera> cameras;
    /** UNIX time of the first frame that has a timestamp, in file order. */
    std::optional<double> first_stamp_s;
};

/** Reads the whole rawlog once. Range scans without a color image are no camera, unless there is
 *  nothing else.
 *  \throws Error when it is missing, damaged or without such frames */
CameraSurvey surveyCameras(const std::string& rawlog_path);

}  // namespace rgbd_graphslam
