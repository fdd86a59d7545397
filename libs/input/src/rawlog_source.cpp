#include "rgbd_graphslam/input/rawlog_source.h"

#include "rgbd_graphslam/input/live_recorder.h"

namespace rgbd_graphslam {

mrpt::obs::CObservation::Ptr RawlogSource::next() {
    auto observation = reader_.next();
    if (observation && live_survey_frames_ == 0) {
        live_survey_frames_ = surveyedFrames(*observation);
    }
    return observation;
}

}  // namespace rgbd_graphslam
