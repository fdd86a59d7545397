#include "panel_contents.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/viewer/keyframe_view.h"
#include "scene_colors.h"

namespace rgbd_graphslam {
namespace {

cv::Mat3b decoded(const std::vector<unsigned char>& jpeg) {
    return jpeg.empty() ? cv::Mat3b() : cv::Mat3b(cv::imdecode(jpeg, cv::IMREAD_COLOR));
}

const Rgba& colorOf(FeatureState state) {
    switch (state) {
        case FeatureState::Tracked:
            return tracked_color;
        case FeatureState::New:
            return new_color;
        case FeatureState::Lost:
            break;
    }
    return lost_color;
}

std::vector<PictureMark> marksOf(const LiveFrame& frame) {
    std::vector<PictureMark> marks;
    for (const LiveFeature& feature : frame.features) {
        marks.push_back({feature.u / static_cast<float>(frame.camera.width),
                         feature.v / static_cast<float>(frame.camera.height),
                         colorOf(feature.state)});
    }
    return marks;
}

long count(const LiveFrame& frame, FeatureState state) {
    return std::count_if(frame.features.begin(), frame.features.end(),
                         [&](const LiveFeature& feature) { return feature.state == state; });
}

std::vector<float> errorsCm(const std::vector<TrueError>& errors) {
    std::vector<float> errors_cm;
    errors_cm.reserve(errors.size());
    for (const TrueError& error : errors) errors_cm.push_back(static_cast<float>(100 * error.m()));
    return errors_cm;
}

}  // namespace

void showKeyframe(PicturePanel& panel, const RunScene& scene, std::size_t keyframe) {
    const RunData& run = scene.run();
    const KeyframePicture* picture = scene.picture(keyframe);
    const std::string without = run.rawlog.empty() ? "no recording" : "not yet read";
    panel.color().show(picture ? decoded(picture->color_jpeg) : cv::Mat3b(), without);
    panel.depth().show(picture ? decoded(picture->depth_jpeg) : cv::Mat3b(), without);
    panel.say(formatted("keyframe %zu (0 to %zu), %.2f s", keyframe, run.keyframes.size() - 1,
                        run.keyframes[keyframe].stamp_s - timeSpan(run).first));
}

void showRunPlots(PlotPanel& panel, const RunScene& scene) {
    std::vector<float> landmarks;
    for (const FrameNote& frame : scene.run().frames) {
        landmarks.push_back(frame.lost ? NAN : static_cast<float>(frame.inliers));
    }
    panel.landmarks().show(landmarks);
    panel.times().show(scene.run().frame_times_ms);
    panel.errors().name(scene.errors().empty() ? "error: no ground truth" : "error", " cm");
    panel.errors().show(errorsCm(scene.errors()));
}

std::string summaryOf(const RunScene& scene, std::size_t points) {
    const RunData& run = scene.run();
    const std::string map =
        points == 0 ? "no point cloud" : formatted("%.2f million points", 1e-6 * points);
    return formatted("%s, %zu keyframes, %zu loops; press ? for help", map.c_str(),
                     run.keyframes.size(), run.loops.size());
}

void showLiveFrame(PicturePanel& panel, const LiveFrame& frame) {
    panel.color().show(frame.color, "");
    panel.color().mark(marksOf(frame));
    panel.depth().show(paintedDepth(frame.depth, frame.depth_unit_m), "");
    panel.say(formatted("%ld tracked, %ld new, %ld lost", count(frame, FeatureState::Tracked),
                        count(frame, FeatureState::New), count(frame, FeatureState::Lost)));
}

void showLivePlots(PlotPanel& panel, const std::vector<LiveStatistic>& statistics) {
    std::vector<float> landmarks, times_ms;
    for (const LiveStatistic& statistic : statistics) {
        landmarks.push_back(statistic.lost ? NAN : static_cast<float>(statistic.inliers));
        times_ms.push_back(statistic.frame_ms);
    }
    panel.landmarks().show(landmarks);
    panel.times().show(times_ms);
    panel.errors().name("error: known when the run has ended", "");
}

}  // namespace rgbd_graphslam
