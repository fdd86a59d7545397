#include "rgbd_graphslam/dataset/label_observation.h"

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationImage.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
using namespace mrpt::obs;
namespace {

constexpr double same_stamp_s = 1e-6;

CObservationImage::Ptr grayObservation(const std::string& sensor_label, double stamp_s,
                                       const cv::Mat& pixels) {
    auto observation = CObservationImage::Create();
    observation->sensorLabel = sensor_label;
    observation->timestamp = toMrptTime(stamp_s);
    observation->image = mrpt::img::CImage(pixels, mrpt::img::DEEP_COPY);
    return observation;
}

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::vector<CObservation::Ptr> makeLabelObservations(const std::string& camera_label,
                                                     double stamp_s, const cv::Mat& labels) {
    cv::Mat low, high, remainder;
    cv::bitwise_and(labels, cv::Scalar(255), remainder);
    remainder.convertTo(low, CV_8U);
    cv::Mat(labels - remainder).convertTo(high, CV_8U, 1.0 / 256);
    std::vector<CObservation::Ptr> all = {
        grayObservation(camera_label + label_suffix, stamp_s, low)};
    if (cv::countNonZero(high) > 0) {
        all.push_back(grayObservation(camera_label + label_high_suffix, stamp_s, high));
    }
    return all;
}

bool isLabelSensor(const std::string& sensor_label) {
    return endsWith(sensor_label, label_suffix) || endsWith(sensor_label, label_high_suffix);
}

std::string cameraOfLabels(const std::string& sensor_label) {
    return sensor_label.substr(0, sensor_label.rfind(label_suffix));
}

void maskLabels(CObservation3DRangeScan& frame, const cv::Mat& labels,
                const std::set<int>& left_out) {
    cv::Mat mask(labels.size(), CV_8UC1, cv::Scalar(255));
    if (frame.hasConfidenceImage) {
        const cv::Mat given = frame.confidenceImage.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
        if (given.size() != labels.size() || given.type() != CV_8UC1) return;
        mask = given.clone();
    }
    for (const int label : left_out) mask.setTo(0, labels == label);
    if (cv::countNonZero(mask) < mask.size().area()) setMask(frame, mask);
}

void LabelCollector::note(const CObservation& observation) {
    if (const auto* comment = dynamic_cast<const CObservationComment*>(&observation)) {
        names_.merge(labelsIn(comment->text));
    }
    const auto* image = dynamic_cast<const CObservationImage*>(&observation);
    if (!image || !isLabelSensor(image->sensorLabel)) return;
    const cv::Mat pixels = image->image.asCvMat<cv::Mat>(mrpt::img::DEEP_COPY);
    if (pixels.type() != CV_8UC1) return;
    latest_[image->sensorLabel] = {toSeconds(image->timestamp), pixels};
}

cv::Mat LabelCollector::of(const std::string& camera_label, double stamp_s) const {
    const auto at = [&](const char* suffix) {
        const auto found = latest_.find(camera_label + suffix);
        const bool fits =
            found != latest_.end() && std::abs(found->second.stamp_s - stamp_s) < same_stamp_s;
        return fits ? found->second.pixels : cv::Mat();
    };
    const cv::Mat low = at(label_suffix), high = at(label_high_suffix);
    if (low.empty()) return {};
    cv::Mat labels, high_part;
    low.convertTo(labels, CV_16U);
    if (high.size() != low.size()) return labels;
    high.convertTo(high_part, CV_16U, 256);
    return labels + high_part;
}

}  // namespace rgbd_graphslam
