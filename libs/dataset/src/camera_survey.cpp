#include "camera_survey.h"

#include <algorithm>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation3DRangeScan;
namespace {

void count(std::vector<SurveyedCamera>& cameras, const CObservation3DRangeScan& frame) {
    auto camera = std::find_if(cameras.begin(), cameras.end(),
                               [&](const auto& one) { return one.label == frame.sensorLabel; });
    if (camera == cameras.end()) camera = cameras.insert(cameras.end(), {frame.sensorLabel, 0, 0});
    ++camera->frames;
    camera->stamped += frame.timestamp != INVALID_TIMESTAMP;
}

}  // namespace

CameraSurvey surveyCameras(const std::string& rawlog_path) {
    CameraSurvey survey;
    std::vector<SurveyedCamera> without_color;
    RawlogReader reader(rawlog_path);
    while (const auto observation = reader.next()) {
        const auto* frame = dynamic_cast<const CObservation3DRangeScan*>(observation.get());
        if (!frame) continue;
        count(frame->hasIntensityImage ? survey.cameras : without_color, *frame);
        if (!survey.first_stamp_s && frame->timestamp != INVALID_TIMESTAMP) {
            survey.first_stamp_s = toSeconds(frame->timestamp);
        }
    }
    if (survey.cameras.empty()) survey.cameras = without_color;
    if (survey.cameras.empty()) {
        throw Error("'" + rawlog_path + "' holds no RGB-D frame", "give a rawlog with RGB-D");
    }
    return survey;
}

}  // namespace rgbd_graphslam
