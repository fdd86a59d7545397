/** The window while it follows a run that goes on. */
#include <filesystem>

#include "panel_contents.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/core/process_usage.h"
#include "viewer_window.h"

namespace rgbd_graphslam {
namespace {

constexpr double first_distance_m = 7, first_elevation_rad = 0.8;
/** Of one processor, since the run may need it. The mouse is not held up by this. */
constexpr double live_cpu_share = 0.02;

}  // namespace

void ViewerWindow::follow(const std::string& folder, std::filesystem::file_time_type since) {
    live_ = std::make_unique<LiveRun>(folder, since);
    live_folder_ = folder;
    live_budget_ = CpuBudget(live_cpu_share, processCpuSeconds());
    follow_camera_ = true;
    camera_.distance_m = first_distance_m;
    camera_.elevation_rad = first_elevation_rad;
    panels_->time().setReplayVisible(false);
    panels_->pictures().setLive(true);
    placePanels();
    say("waiting for rgbd-slam to begin with -o " + folder);
}

void ViewerWindow::takeLive() {
    if (!live_) return;
    live_is_new_ |= live_->update();
    if (live_->state() == LiveRun::State::Ended) return endLive();
    if (live_is_new_ && live_->lastFrame() && live_budget_.allows(Clock::now())) showLive();
}

void ViewerWindow::showLive() {
    live_is_new_ = false;
    const LiveFrame& frame = *live_->lastFrame();
    scene_->showClouds(live_->takeMovedClouds());
    scene_->update(*live_);
    replay_.moveTo(frame.stamp_s);
    showLiveFrame(panels_->pictures(), frame);
    showLivePlots(panels_->plots(), live_->statistics());
    const RunData& run = live_->run();
    panels_->time().say(
        formatted("%s at %.2f s, %zu keyframes, %zu loops", frame.lost ? "LOST" : "tracking",
                  frame.stamp_s - timeSpan(run).first, run.keyframes.size(), run.loops.size()));
    live_panels_changed_ = true;
    sceneChanged();
}

/** Shows the result, unless the run was killed before it wrote one. */
void ViewerWindow::endLive() {
    const bool has_result = live_->hasResult();
    live_.reset();
    panels_->pictures().setLive(false);
    if (!has_result) return say("rgbd-slam has ended without a result");
    try {
        open(loadRun(live_folder_));
        say("the run has ended; this is its result");
    } catch (const Error& e) {
        say(e.what());
    }
}

}  // namespace rgbd_graphslam
