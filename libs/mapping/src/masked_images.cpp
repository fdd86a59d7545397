#include "rgbd_graphslam/mapping/masked_images.h"

#include "rgbd_graphslam/dataset/label_observation.h"

namespace rgbd_graphslam {
namespace {

Keyframe3D without(const std::set<int>& classes, const cv::Mat& labels, Keyframe3D keyframe) {
    if (labels.size() != keyframe.image.depth.size()) return keyframe;
    keyframe.image.depth = keyframe.image.depth.clone();
    for (const int label : classes) keyframe.image.depth.setTo(0, labels == label);
    return keyframe;
}

}  // namespace

std::size_t MaskedImages::forEach(const Trajectory& keyframes, const std::string& label,
                                  const Consume& consume, const Note& note) const {
    LabelCollector labels;
    std::string camera = camera_label_;
    const auto collect = [&](const mrpt::obs::CObservation& entry) {
        labels.note(entry);
        if (camera_label_.empty() && isLabelSensor(entry.sensorLabel))
            camera = cameraOfLabels(entry.sensorLabel);
        if (note) note(entry);
    };
    const auto consume_rest = [&](const Keyframe3D& keyframe) {
        consume(without(labelsNamed(labels.names(), classes_),
                        labels.of(camera, keyframe.pose.stamp_s), keyframe));
    };
    return images_->forEach(keyframes, label, consume_rest, collect);
}

}  // namespace rgbd_graphslam
