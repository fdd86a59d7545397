/** What keys, mouse and panels of the window set off. */
#include <algorithm>

#include "panel_contents.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/viewer/map_export.h"
#include "rgbd_graphslam/viewer/picking.h"
#include "viewer_window.h"

namespace rgbd_graphslam {
namespace {

constexpr int pick_radius_px = 5;
/** Of the marks at measured points, as a share of the distance they are seen from. */
constexpr double cross_share = 0.01;

}  // namespace

void ViewerWindow::placePanels() {
    panels_->place();
    panelsChanged();
}

void ViewerWindow::say(const std::string& text) {
    panels_->time().say(text);
    panelsChanged();
}

void ViewerWindow::showTime() {
    const auto share = static_cast<float>(replay_.share());
    panels_->time().show(share, replay_.playing(), replay_.text());
    panels_->plots().setCursor(replay_.now() ? share : -1);
    panelsChanged();
}

std::size_t ViewerWindow::keyframesByNow() const {
    const RunData& run = scene_->run();
    return replay_.now() ? replayAt(run, *replay_.now()).keyframes : run.keyframes.size();
}

std::optional<std::size_t> ViewerWindow::keyframeInPanel() const {
    const std::size_t by_now = keyframesByNow();
    if (by_now == 0) return std::nullopt;
    return selected_.value_or(by_now - 1);
}

void ViewerWindow::showPictures() {
    const auto keyframe = keyframeInPanel();
    if (!keyframe) return;
    showKeyframe(panels_->pictures(), *scene_, *keyframe);
    panelsChanged();
}

void ViewerWindow::advanceReplay() {
    if (replay_.advance(Clock::now())) moveTo(replay_.now());
}

void ViewerWindow::moveTo(std::optional<double> stamp_s) {
    if (live_) return;  // the present moment is shown
    replay_.moveTo(stamp_s);
    if (stamp_s) select(std::nullopt);
    showPictures();
    showTime();
    sceneChanged();
}

void ViewerWindow::play(bool play) {
    if (live_) return;
    replay_.play(play, Clock::now());
    moveTo(replay_.now());
}

void ViewerWindow::stepKeyframe(int step) {
    const Trajectory& keyframes = scene_->run().keyframes;
    if (keyframes.empty()) return;
    const int last = static_cast<int>(keyframes.size()) - 1;
    const int shown =
        selected_ ? static_cast<int>(*selected_) : static_cast<int>(keyframesByNow()) - 1;
    moveTo(keyframes[std::clamp(shown + step, 0, last)].stamp_s);
}

void ViewerWindow::fit() {
    const cv::Rect area = panels_->freeArea();
    if (!scene_->box().isEmpty()) {
        scene_->frame(camera_, mFBSize,
                      {double(area.width) / width(), double(area.height) / height()});
        const Eigen::Vector2d middle(area.x + area.width / 2., area.y + area.height / 2.);
        camera_.pan(pixelRatio() * (middle - 0.5 * size().cast<double>()), mFBSize.y());
    }
    follow_camera_ = false;
    sceneChanged();
}

void ViewerWindow::lookDown() {
    camera_.lookDown();
    sceneChanged();
}

void ViewerWindow::toggleFollowing() {
    follow_camera_ = !follow_camera_;
    say(follow_camera_ ? "following the camera" : "no longer following the camera");
    sceneChanged();
}

void ViewerWindow::toggleColors() {
    settings_.colors = settings_.colors == "height" ? "camera" : "height";
    panels_->view().refresh();
    sceneChanged();
}

void ViewerWindow::flip(bool ViewerSettings::*field) {
    const std::string why = whyNothingToShow(field, live_ ? liveContents() : scene_->contents());
    if (!why.empty()) return say(why);
    settings_.*field = !(settings_.*field);
    panels_->view().refresh();
    sceneChanged();
}

void ViewerWindow::select(std::optional<std::size_t> keyframe) {
    selected_ = keyframe;
    scene_->select(keyframe);
    showPictures();
    sceneChanged();
}

std::optional<Eigen::Vector3d> ViewerWindow::surfaceUnder(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2i center = pixel.cast<int>();
    return surfaceAt(renderer_->depthsAround(center, pick_radius_px), center, camera_, mFBSize);
}

void ViewerWindow::click(const Eigen::Vector2d& pixel) {
    if (measuring_.active()) return measureAt(pixel);
    if (live_) return;
    const std::size_t shown = settings_.keyframes ? keyframesByNow() : 0;
    select(keyframeAt(scene_->run().keyframes, shown, pixel, camera_, mFBSize));
}

void ViewerWindow::lookAt(const Eigen::Vector2d& pixel) {
    const auto point = surfaceUnder(pixel);
    if (!point) return;
    camera_.distance_m = (camera_.eye() - *point).norm();
    camera_.target = *point;
    sceneChanged();
}

void ViewerWindow::toggleMeasuring() {
    say(measuring_.toggle());
    scene_->markPoints({}, 0);
    sceneChanged();
}

void ViewerWindow::measureAt(const Eigen::Vector2d& pixel) {
    say(measuring_.add(surfaceUnder(pixel)));
    scene_->markPoints(measuring_.points(), cross_share * camera_.distance_m);
    sceneChanged();
}

/** Closes a panel, or ends what was begun. */
void ViewerWindow::escape() {
    if (panels_->closeMiddle()) return panelsChanged();
    if (measuring_.active()) return toggleMeasuring();
    select(std::nullopt);
}

void ViewerWindow::takeScreenshot() {
    try {
        const std::string path = freeName(outputFolder(), "view", ".png");
        saveScreenshot(path);
        say("saved " + path);
    } catch (const Error& e) {
        say(e.what());
    }
}

void ViewerWindow::exportMap(ExportFormat format) {
    try {
        const std::string path = freeName(outputFolder(), "export", extensionOf(format));
        if (format == ExportFormat::Ply || format == ExportFormat::Pcd) {
            exportPoints(renderer_->shownPoints(), format, path);
        } else if (format == ExportFormat::Mesh) {
            exportMesh(outputFolder(), sceneView().highest_m, path);
        } else {
            exportOctree(outputFolder(), sceneView().highest_m, format, path);
        }
        say("wrote " + path);
    } catch (const Error& e) {
        say(e.what());
    }
}

}  // namespace rgbd_graphslam
