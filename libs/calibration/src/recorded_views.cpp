#include "recorded_views.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>

#include <cmath>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/depth_stamps.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation3DRangeScan;
namespace {

/** Of the first views, so that memory stays flat: 400 images of 640x480 are 245 MB. */
constexpr std::size_t most_with_depth = 400;

cv::Mat rawDepth(const CObservation3DRangeScan& frame) {
    const auto& ranges = frame.rangeImage;
    return cv::Mat(static_cast<int>(ranges.rows()), static_cast<int>(ranges.cols()), CV_16UC1,
                   const_cast<std::uint16_t*>(ranges.data()))
        .clone();
}

/** Depth units that files state are whole numbers; a float in the rawlog is their inverse. */
double unitsPerMeter(double unit_m) {
    const double units = 1 / unit_m;
    return std::abs(units - std::round(units)) < 1e-4 * units ? std::round(units) : units;
}

class ViewCollector {
  public:
    ViewCollector(const std::string& rawlog, const std::string& label,
                  const BoardDetector& detector)
        : reader_(rawlog), label_(label), detector_(detector) {}

    RecordedViews collect() {
        Progress progress("looking for the board", 100, "%");
        while (const auto observation = reader_.next()) {
            note(*observation);
            const auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(observation);
            if (frame && isWanted(*frame)) add(frame);
            progress.update(static_cast<std::size_t>(100 * reader_.progress()));
        }
        for (RecordedView& view : found_.views) {
            const auto late = stamps_.find(std::llround(1e6 * view.stamp_s));
            view.depth_stamp_s =
                late == stamps_.end() ? view.stamp_s : 1e-6 * static_cast<double>(late->second);
        }
        return std::move(found_);
    }

  private:
    void note(const mrpt::obs::CObservation& observation) {
        const auto* comment = dynamic_cast<const mrpt::obs::CObservationComment*>(&observation);
        if (comment) stamps_.merge(depthStampsIn(comment->text));
    }

    bool isWanted(const CObservation3DRangeScan& frame) {
        if (found_.frames == 0 && label_.empty()) label_ = frame.sensorLabel;
        return frame.sensorLabel == label_ && frame.hasIntensityImage && frame.hasRangeImage;
    }

    void add(const CObservation3DRangeScan::Ptr& frame) {
        const RgbdImage image = toRgbdImage(frame);
        if (found_.frames++ == 0) describe(*frame, image.gray.size());
        RecordedView view;
        view.board = detector_.find(image.gray);
        if (view.board.empty()) return;
        view.stamp_s = image.stamp_s;
        if (found_.views.size() < most_with_depth) view.depth = rawDepth(*frame);
        found_.views.push_back(std::move(view));
    }

    void describe(const CObservation3DRangeScan& frame, cv::Size size) {
        found_.setup.name = "recording";
        found_.setup.camera = cameraOf(frame);
        found_.setup.camera.width = size.width;
        found_.setup.camera.height = size.height;
        found_.setup.depth_units = unitsPerMeter(frame.rangeUnits);
        found_.setup.T_base_sensor = cameraOnRobot(frame) * T_optical_from_mrpt;
        found_.depth.unit_m = 1 / found_.setup.depth_units;
        found_.depth.camera = toCamera(frame.cameraParams);
        found_.depth.registered = frame.doDepthAndIntensityCamerasCoincide() &&
                                  found_.depth.camera == toCamera(frame.cameraParamsIntensity);
        if (found_.depth.registered) return;
        found_.depth.T_color_depth =
            toSE3(frame.relativePoseIntensityWRTDepth).inverse() * T_optical_from_mrpt.inverse();
    }

    RawlogReader reader_;
    std::string label_;
    const BoardDetector& detector_;
    DepthStamps stamps_;
    RecordedViews found_;
};

}  // namespace

RecordedViews readViews(const std::string& rawlog, const std::string& sensor_label,
                        const BoardDetector& detector) {
    RecordedViews views = ViewCollector(rawlog, sensor_label, detector).collect();
    if (views.frames > 0) return views;
    throw Error("'" + rawlog + "' has no RGB-D frame" +
                    (sensor_label.empty() ? std::string() : " of '" + sensor_label + "'"),
                "record the board with the RGB-D camera, and check --sensor");
}

}  // namespace rgbd_graphslam
