#include "viewer_window.h"

#include <nanogui/opengl.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "panel_contents.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/mapping/recorded_images.h"
#include "scene_overlay.h"

namespace rgbd_graphslam {
namespace {

constexpr double hint_delay_s = 0.5;
constexpr double busy_wait_s = 0.001, reading_wait_s = 0.05, idle_wait_s = 1;
/** Of a picture while the view moves, what the scene gets of it at least, and what the scene of a
 *  running SLAM gets. */
constexpr double picture_time_s = 0.042, least_scene_time_s = 0.01, live_scene_time_s = 0.015;

}  // namespace

ViewerWindow::ViewerWindow(const ViewerSettings& settings, const std::string& title)
    : nanogui::Screen({settings.window_width, settings.window_height}, title),
      settings_(settings),
      renderer_(std::make_unique<SceneRenderer>()),
      scene_(std::make_unique<RunScene>(*renderer_)),
      panel_layer_(std::make_unique<RenderTarget>()) {
    styleTheme();
    if (settings_.window_x >= 0)
        glfwSetWindowPos(glfwWindow(), settings_.window_x, settings_.window_y);
    glfwSwapInterval(0);  // pictures are drawn when something changes, not at the screen's rate
    for (auto shortcuts : {viewShortcuts(), toolShortcuts()})
        shortcuts_.insert(shortcuts_.end(), shortcuts.begin(), shortcuts.end());
    panels_ = std::make_unique<PanelSet>(*this, settings_, shortcuts_, [this] { sceneChanged(); });
    connectPanels();
    placePanels();
}

ViewerWindow::~ViewerWindow() = default;

ViewerSettings ViewerWindow::settings() const {
    ViewerSettings settings = settings_;
    auto* window = const_cast<ViewerWindow*>(this)->glfwWindow();
    glfwGetWindowSize(window, &settings.window_width, &settings.window_height);
    glfwGetWindowPos(window, &settings.window_x, &settings.window_y);
    panels_->store(settings);
    return settings;
}

void ViewerWindow::open(RunData run) {
    const bool has_recording = !run.rawlog.empty();
    loader_.reset();
    if (has_recording) {
        loader_ = std::make_unique<RecordingLoader>(std::make_unique<RecordedImages>(RecordedCamera(
                                                        run.rawlog, run.sensor_label, run.entries)),
                                                    run.keyframes);
    }
    all_read_ = !has_recording;
    camera_known_ = false;
    follow_camera_ = false;
    const auto [first_s, last_s] = timeSpan(run);
    replay_.reset(first_s, last_s);
    panels_->time().setReplayVisible(true);
    panels_->pictures().setLive(false);
    placePanels();
    showAtOnce("arranging the map ...");
    scene_->show(std::move(run));
    select(std::nullopt);
    fit();
    panels_->view().nameErrors(scene_->errorScale());
    panels_->offer(scene_->contents());
    showRunPlots(panels_->plots(), *scene_);
    showTime();
    say(summaryOf(*scene_, points()));
}

/** Before something that takes long. */
void ViewerWindow::showAtOnce(const std::string& text) {
    say(text);
    renderer_->draw(sceneView());
    drawAll();
}

bool ViewerWindow::settled() const {
    return !live_ && all_read_ && renderer_->complete() && !scene_changed_ && !panels_changed_ &&
           !picture_changed_;
}

double ViewerWindow::update() {
    takeLive();
    takeRecording();
    advanceReplay();
    if (scene_changed_) {
        renderer_->draw(sceneView());
        scene_changed_ = false;
        picture_changed_ = true;
    } else if (!renderer_->complete() && !live_) {
        renderer_->refine();
        picture_changed_ |= renderer_->complete();
    }
    panels_changed_ |= mLastInteraction != last_drawn_interaction_ && !mouse_.pressed();
    const double hint_wait_s = updateHint();
    if (panels_changed_ || picture_changed_) {
        drawAll();
        if (live_) keepLiveBudget();
        shows_run_ = !live_ || live_->lastFrame();
    }
    if (live_) return std::min(liveWait(), hint_wait_s);
    if (replay_.playing() || !renderer_->complete()) return busy_wait_s;
    return std::min(all_read_ ? idle_wait_s : reading_wait_s, hint_wait_s);
}

/** Shows the tooltip of what the mouse rests on. \return when it may have to be shown, s */
double ViewerWindow::updateHint() {
    const double rest_s = glfwGetTime() - mLastInteraction;
    const nanogui::Widget* widget = findWidget(mMousePos);
    const bool shows = rest_s > hint_delay_s && widget && !mouse_.pressed();
    panels_changed_ |= panels_->hint(shows ? widget->tooltip() : "", mMousePos);
    return rest_s > hint_delay_s ? idle_wait_s : hint_delay_s - rest_s + busy_wait_s;
}

/** Opaque panels can be copied over the scene; drawing them anew for each picture of a moving scene
 *  would take as long as the scene. */
void ViewerWindow::styleTheme() {
    theme()->mWindowDropShadowSize = 0;
    theme()->mWindowCornerRadius = 0;
    theme()->mWindowFillFocused = theme()->mWindowFillUnfocused = nanogui::Color(45, 48, 54, 255);
}

void ViewerWindow::drawPanels() {
    panel_layer_->resize(mFBSize);
    panel_layer_->bind();
    glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    const double last_interaction = std::exchange(mLastInteraction, glfwGetTime());
    drawWidgets();  // without tooltips, which it draws when the mouse has rested
    mLastInteraction = last_interaction;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    last_drawn_interaction_ = mLastInteraction;
    panels_changed_ = live_panels_changed_ = false;
}

/** Of a running SLAM, over the panels as they are. Without a graphics card all panels anew would
 *  take as long as the scene. */
void ViewerWindow::drawLivePanels() {
    if (panels_->anyOverOthers()) return drawPanels();  // and may lie over them
    panel_layer_->bind();
    nvgBeginFrame(mNVGContext, static_cast<float>(width()), static_cast<float>(height()),
                  mPixelRatio);
    for (nanogui::Widget* widget : panels_->liveWidgets()) {
        if (widget->visibleRecursive()) drawOver(mNVGContext, *widget, theme()->mWindowFillFocused);
    }
    nvgEndFrame(mNVGContext);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    live_panels_changed_ = false;
}

/** Draws to the back buffer. */
void ViewerWindow::compose() {
    if (panels_changed_) drawPanels();
    if (live_panels_changed_) drawLivePanels();
    picture_changed_ = false;
    renderer_->copyToWindow();
    drawOverlay();
    const float scale = pixelRatio();
    for (const nanogui::Widget* panel : children()) {
        if (!panel->visible()) continue;
        const Eigen::Vector2i corner = (scale * panel->position().cast<float>()).cast<int>();
        const Eigen::Vector2i size = (scale * panel->size().cast<float>()).cast<int>();
        panel_layer_->copyToWindow(cv::Rect(corner.x(), corner.y(), size.x(), size.y()), mFBSize);
    }
}

/** Distances, scale bar and colors of heights, over the scene and below the panels. */
void ViewerWindow::drawOverlay() {
    SceneOverlay overlay;
    overlay.area = panels_->freeArea();
    overlay.m_per_px = pixelRatio() * camera_.distance_m / OrbitCamera::focalPx(mFBSize.y());
    if (settings_.floor && scene_->floor())
        overlay.labels = floorLabels(*scene_->floor(), camera_, {width(), height()});
    if (settings_.colors == "height" && !scene_->box().isEmpty())
        overlay.heights_m = {scene_->box().min().z(), scene_->box().max().z()};
    glViewport(0, 0, mFBSize.x(), mFBSize.y());
    nvgBeginFrame(mNVGContext, static_cast<float>(width()), static_cast<float>(height()),
                  mPixelRatio);
    drawSceneOverlay(mNVGContext, overlay);
    nvgEndFrame(mNVGContext);
}

void ViewerWindow::drawAll() {
    const auto start = Clock::now();
    compose();
    glfwSwapBuffers(glfwWindow());
    const std::chrono::duration<double> taken = Clock::now() - start;
    compose_s_ += 0.2 * (taken.count() - compose_s_);
}

SceneView ViewerWindow::sceneView() {
    if (follow_camera_) {
        const auto [first, last] = timeSpan(scene_->run());
        if (const auto pose = poseNear(scene_->run().trajectory, replay_.now().value_or(last)))
            camera_.target = pose->t;
    }
    scene_->markNow(replay_.now());
    scene_->prepare(settings_);
    SceneView view = scene_->viewAt(replay_.now(), settings_);
    view.camera = camera_;
    view.size_px = mFBSize;
    view.time_s =
        live_ ? live_scene_time_s : std::max(least_scene_time_s, picture_time_s - compose_s_);
    return view;
}

bool ViewerWindow::hasPictureForPanel() const {
    const auto keyframe = keyframeInPanel();
    return keyframe && scene_->picture(*keyframe);
}

void ViewerWindow::takeRecording() {
    if (!loader_ || all_read_) return;
    RecordingLoader::News news = loader_->take();
    all_read_ = news.finished;
    if (news.camera) {
        const bool had_picture = hasPictureForPanel();
        scene_->add(std::move(news));
        if (!had_picture && hasPictureForPanel()) showPictures();
        // The fused map stays as it is, and need not be drawn anew.
        const bool shows_keyframe_clouds = replay_.now() || points() == 0;
        if (shows_keyframe_clouds || !std::exchange(camera_known_, true)) sceneChanged();
    }
    if (all_read_ && points() == 0) fit();  // now that there is something to see
}

void ViewerWindow::saveScreenshot(const std::string& path) {
    compose();
    cv::Mat4b rgba(mFBSize.y(), mFBSize.x());
    glReadPixels(0, 0, rgba.cols, rgba.rows, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data);
    glfwSwapBuffers(glfwWindow());
    cv::Mat bgr;
    cv::cvtColor(rgba, bgr, cv::COLOR_RGBA2BGR);
    cv::flip(bgr, bgr, 0);
    writeAtomically(path,
                    [&](const std::string& temporary) { return cv::imwrite(temporary, bgr); });
}

double ViewerWindow::spin(double seconds) {
    int pictures = 0;
    const auto start = Clock::now();
    std::chrono::duration<double> passed{};
    while (passed.count() < seconds) {
        camera_.orbit({10, 0});
        renderer_->draw(sceneView());
        drawAll();
        ++pictures;
        passed = Clock::now() - start;
    }
    return pictures / passed.count();
}

}  // namespace rgbd_graphslam
