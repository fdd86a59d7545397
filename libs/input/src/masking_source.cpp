#include "rgbd_graphslam/input/masking_source.h"

#include <mrpt/obs/CObservation3DRangeScan.h>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation3DRangeScan;

mrpt::obs::CObservation::Ptr MaskingSource::next() {
    const auto observation = source_->next();
    if (!observation) return observation;
    labels_.note(*observation);
    const auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
    if (!frame || frame->timestamp == INVALID_TIMESTAMP) return observation;
    const cv::Mat labels = labels_.of(frame->sensorLabel, toSeconds(frame->timestamp));
    if (!labels.empty()) {
        maskLabels(*frame, labels, labelsNamed(labels_.names(), moving_classes_));
    }
    return observation;
}

}  // namespace rgbd_graphslam
