/** The window while it follows a run that goes on. */
#include <algorithm>
#include <filesystem>

#include "panel_contents.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/core/process_usage.h"
#include "viewer_window.h"

namespace rgbd_graphslam {
namespace {

constexpr double first_distance_m = 7, first_elevation_rad = 0.8;
/** While a picture is to come, and while none has been asked for. */
constexpr double picture_wait_s = 0.03, longest_wait_s = 0.2;

}  // namespace

void ViewerWindow::follow(const std::string& folder, std::filesystem::file_time_type since) {
    live_ = std::make_unique<LiveRun>(folder, since);
    live_folder_ = folder;
    live_budget_ = CpuBudget(shareBesideSlam(0), processCpuSeconds());
    idle_time_.processors(Clock::now());
    follow_camera_ = true;
    camera_.distance_m = first_distance_m;
    camera_.elevation_rad = first_elevation_rad;
    panels_->time().setReplayVisible(false);
    panels_->pictures().setLive(true);
    panels_->offer(liveContents());
    placePanels();
    say("waiting for rgbd-slam to begin with -o " + folder);
}

void ViewerWindow::takeLive() {
    if (!live_) return;
    const bool has_picture = live_->update();
    if (live_->state() == LiveRun::State::Ended) return endLive();
    if (has_picture) return showLive();
    if (live_budget_.allows(Clock::now())) live_->askForPicture();
}

/** The run may need the processor: the next picture is drawn when this one has been made up for.
 * The mouse is not held up by this. */
void ViewerWindow::keepLiveBudget() {
    const auto now = Clock::now();
    live_budget_.setShare(shareBesideSlam(idle_time_.processors(now)));
    live_budget_.spent(now, processCpuSeconds());
}

double ViewerWindow::liveWait() const {
    if (live_->state() == LiveRun::State::Waiting) return picture_wait_s;
    return std::clamp(live_budget_.rest(Clock::now()), picture_wait_s, longest_wait_s);
}

void ViewerWindow::showLive() {
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
