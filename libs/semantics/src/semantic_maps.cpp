#include "rgbd_graphslam/semantics/semantic_maps.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/label_observation.h"
#include "rgbd_graphslam/mapping/depth_timing.h"
#include "rgbd_graphslam/mapping/plan_view.h"
#include "rgbd_graphslam/mapping/recorded_images.h"
#include "rgbd_graphslam/semantics/segmentation_network.h"
#include "semantic_files.h"

namespace rgbd_graphslam {
namespace {

constexpr const char* file_names[] = {"labels.ply", "labels.png", "objects.json"};

struct LabeledView {
    double stamp_s;
    std::vector<LabelSight> sights;
};

/** All that the keyframes' label images say. */
struct LabeledMap {
    explicit LabeledMap(double voxel_m) : fusion(voxel_m) {}

    void add(const Keyframe3D& keyframe, const cv::Mat& labels, const MapInputs& inputs,
             const MapOptions& options) {
        if (!rays) rays.emplace(keyframe.camera);
        const SE3 T_world_cam = depthPose(keyframe.pose, keyframe.depth_stamp_s, inputs.trajectory);
        const DepthView view(keyframe.image, *rays, options);
        views.push_back({keyframe.pose.stamp_s, fusion.insert(T_world_cam, view, labels)});
    }

    LabelFusion fusion;
    LabelSet names;
    std::optional<RayTable> rays;
    std::vector<LabeledView> views;
};

/** The keyframes of the run's own recording. */
Trajectory ownKeyframes(const MapInputs& inputs) {
    std::size_t earlier = 0;
    for (const EarlierSession& session : inputs.earlier) earlier += session.keyframes;
    return {inputs.keyframes.begin() + static_cast<std::ptrdiff_t>(earlier),
            inputs.keyframes.end()};
}

/** Frames that label images are taken of: more than keyframes, since wrong images are to be
 *  outvoted. A network takes its time, and gets keyframes only. */
Trajectory framesToLabel(const MapInputs& inputs, const SemanticOptions& options) {
    constexpr double shortest_s = 0.03;
    if (!options.model.empty()) return ownKeyframes(inputs);
    Trajectory frames;
    for (const StampedPose& pose : inputs.trajectory) {
        if (frames.empty() || pose.stamp_s - frames.back().stamp_s > shortest_s) {
            frames.push_back(pose);
        }
    }
    return frames;
}

/** Where the labels of a keyframe come from: label images of the recording, or a network. */
class LabelSource {
  public:
    LabelSource(const SemanticOptions& options, std::string camera_label)
        : camera_label_(std::move(camera_label)), any_camera_(camera_label_.empty()) {
        if (!options.model.empty()) network_.emplace(options);
    }
    void note(const mrpt::obs::CObservation& entry) {
        recorded_.note(entry);
        if (any_camera_ && isLabelSensor(entry.sensorLabel))
            camera_label_ = cameraOfLabels(entry.sensorLabel);
    }
    cv::Mat of(const Keyframe3D& keyframe) {
        if (!network_) return recorded_.of(camera_label_, keyframe.pose.stamp_s);
        return keyframe.image.color.empty() ? cv::Mat() : network_->labelsOf(keyframe.image.color);
    }
    const LabelSet& names() const { return network_ ? network_->names() : recorded_.names(); }

  private:
    LabelCollector recorded_;
    std::optional<SegmentationNetwork> network_;
    std::string camera_label_;
    bool any_camera_;
};

LabeledMap labeledMap(const MapInputs& inputs, const MapOptions& maps,
                      const SemanticOptions& options) {
    LabeledMap map(options.label_voxel_m);
    LabelSource labels(options, inputs.sensor_label);
    RecordedImages({inputs.rawlog, inputs.sensor_label, inputs.entries})
        .forEach(
            framesToLabel(inputs, options), "labels",
            [&](const Keyframe3D& keyframe) {
                cv::Mat seen = labels.of(keyframe);
                for (const int moving : labelsNamed(labels.names(), options.moving_classes)) {
                    seen.setTo(0, seen == moving);
                }
                if (seen.size() == keyframe.image.depth.size())
                    map.add(keyframe, seen, inputs, maps);
            },
            [&](const mrpt::obs::CObservation& entry) { labels.note(entry); });
    map.names = labels.names();
    return map;
}

ObjectViews viewsOf(const FoundObjects& objects, const std::vector<LabeledView>& views) {
    constexpr int nothing = std::numeric_limits<int>::max();
    ObjectViews result(objects.objects.size());
    for (const LabeledView& view : views) {
        std::vector<ObjectView> boxes(result.size(), {view.stamp_s, nothing, nothing, -1, -1});
        for (const LabelSight& sight : view.sights) {
            const auto object = objects.object_of_voxel.find(sight.voxel);
            if (object == objects.object_of_voxel.end()) continue;
            ObjectView& box = boxes[static_cast<std::size_t>(object->second)];
            box.u_min = std::min<int>(box.u_min, sight.u);
            box.v_min = std::min<int>(box.v_min, sight.v);
            box.u_max = std::max<int>(box.u_max, sight.u);
            box.v_max = std::max<int>(box.v_max, sight.v);
        }
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (boxes[i].u_max >= 0) result[i].push_back(boxes[i]);
        }
    }
    return result;
}

}  // namespace

void removeSemanticMaps(const std::string& folder) {
    std::error_code ignored;
    for (const char* name : file_names) std::filesystem::remove(folder + "/" + name, ignored);
}

bool hasLabels(const std::string& run_folder) {
    std::ifstream in(run_folder + "/summary.json");
    const auto summary = nlohmann::json::parse(in, nullptr, false);
    if (!summary.is_object() || !summary.contains("sensors")) return false;
    const auto& sensors = summary["sensors"];
    return std::any_of(sensors.begin(), sensors.end(), [](const nlohmann::json& sensor) {
        return sensor.is_object() && isLabelSensor(sensor.value("label", ""));
    });
}

SemanticSummary writeSemanticMaps(const MapInputs& inputs, const MapOptions& maps,
                                  const SemanticOptions& options, const std::string& out_folder) {
    const MapInputs connected = withoutDisconnected(inputs);
    const LabeledMap map = labeledMap(connected, maps, options);
    if (map.views.empty()) {
        removeSemanticMaps(out_folder);
        return {};
    }
    const FoundObjects objects = findObjects(map.fusion, map.names, options);
    const auto path = [&](const char* name) { return out_folder + "/" + name; };
    saveLabeledPly(path("labels.ply"), map.fusion, map.names, objects, options);
    const cv::Mat picture = planView(connected, pointsByClass(map.fusion, map.names));
    writeAtomically(path("labels.png"),
                    [&](const std::string& temporary) { return cv::imwrite(temporary, picture); });
    saveObjects(path("objects.json"), objects, map.names, viewsOf(objects, map.views));
    return {map.views.size(), map.fusion.voxels().entries().size(), objects.objects.size()};
}

}  // namespace rgbd_graphslam
