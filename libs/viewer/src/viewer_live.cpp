/** The window while it follows a run that goes on. */
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/viewer/keyframe_view.h"
#include "viewer_window.h"

namespace rgbd_graphslam {
namespace {

constexpr double first_distance_m = 7, first_elevation_rad = 0.8;
const nanogui::Color tracked_color(60, 220, 90, 255), new_color(70, 150, 255, 255),
    lost_color(255, 60, 60, 255);

const nanogui::Color& colorOf(FeatureState state) {
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

template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof(text), format, values...);
    return text;
}

}  // namespace

void ViewerWindow::follow(const std::string& folder, std::filesystem::file_time_type since) {
    live_ = std::make_unique<LiveRun>(folder, since);
    live_folder_ = folder;
    follow_camera_ = true;
    camera_.distance_m = first_distance_m;
    camera_.elevation_rad = first_elevation_rad;
    time_panel_->setReplayVisible(false);
    placePanels();
    say("waiting for rgbd-slam to begin with -o " + folder);
}

void ViewerWindow::takeLive() {
    if (!live_) return;
    live_is_new_ |= live_->update();
    if (live_->state() == LiveRun::State::Ended) return endLive();
    if (live_is_new_ && live_->lastFrame() && Clock::now() >= next_live_picture_) showLive();
}

/** Pictures are drawn so rarely that drawing takes little of the time, since the run may need the
 *  processor; the mouse is not held up by this. \param start of the last picture's drawing */
void ViewerWindow::restAfterDrawing(Clock::time_point start) {
    constexpr int rest = 9;
    const auto now = Clock::now();
    next_live_picture_ = now + rest * (now - start);
}

void ViewerWindow::showLive() {
    live_is_new_ = false;
    const LiveFrame& frame = *live_->lastFrame();
    scene_->showClouds(live_->takeMovedClouds());
    scene_->update(*live_);
    now_s_ = frame.stamp_s;
    showLivePictures(frame);
    showLivePlots();
    const RunData& run = live_->run();
    say(formatted("%s at %.2f s, %zu keyframes, %zu loops", frame.lost ? "LOST" : "tracking",
                  frame.stamp_s - timeSpan(run).first, run.keyframes.size(), run.loops.size()));
    sceneChanged();
}

void ViewerWindow::showLivePictures(const LiveFrame& frame) {
    const LiveImages images = imagesOf(frame);
    picture_panel_->color().show(images.color, "");
    picture_panel_->color().mark(marksOf(frame));
    picture_panel_->depth().show(paintedDepth(images.depth, frame.depth_unit_m), "");
    picture_panel_->say(
        formatted("%ld tracked, %ld new, %ld lost", count(frame, FeatureState::Tracked),
                  count(frame, FeatureState::New), count(frame, FeatureState::Lost)));
}

void ViewerWindow::showLivePlots() {
    std::vector<float> landmarks, times_ms;
    for (const LiveStatistic& statistic : live_->statistics()) {
        landmarks.push_back(statistic.lost ? NAN : static_cast<float>(statistic.inliers));
        times_ms.push_back(statistic.frame_ms);
    }
    plot_panel_->upper().name("tracked landmarks", "");
    plot_panel_->upper().show(std::move(landmarks));
    plot_panel_->lower().name("frame time", " ms");
    plot_panel_->lower().show(std::move(times_ms));
    panels_changed_ = true;
}

/** Shows the result, unless the run was killed before it wrote one. */
void ViewerWindow::endLive() {
    const bool has_result = live_->hasResult();
    live_.reset();
    picture_panel_->color().mark({});
    if (!has_result) return say("rgbd-slam has ended without a result");
    try {
        open(loadRun(live_folder_));
        say("the run has ended; this is its result");
    } catch (const Error& e) {
        say(e.what());
    }
}

}  // namespace rgbd_graphslam
