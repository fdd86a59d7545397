#include "viewer_window.h"

#include <nanogui/opengl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/viewer/picking.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr int margin_px = 8, click_slack_px = 4, pick_radius_px = 5;
constexpr double double_click_s = 0.4, zoom_a_notch = 0.85;
constexpr double busy_wait_s = 0.001, reading_wait_s = 0.05, idle_wait_s = 1;

template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof(text), format, values...);
    return text;
}

cv::Mat3b decoded(const std::vector<unsigned char>& jpeg) {
    return jpeg.empty() ? cv::Mat3b() : cv::Mat3b(cv::imdecode(jpeg, cv::IMREAD_COLOR));
}

/** The first of view-1.png, view-2.png, … that does not exist. */
std::string freeScreenshotName(const fs::path& folder) {
    for (int number = 1;; ++number) {
        const fs::path path = folder / ("view-" + std::to_string(number) + ".png");
        if (!fs::exists(path)) return path.string();
    }
}

}  // namespace

ViewerWindow::ViewerWindow(const ViewerSettings& settings, const std::string& title)
    : nanogui::Screen({settings.window_width, settings.window_height}, title),
      settings_(settings),
      renderer_(std::make_unique<SceneRenderer>()),
      scene_(std::make_unique<RunScene>(*renderer_)),
      panels_(std::make_unique<RenderTarget>()) {
    styleTheme();
    if (settings_.window_x >= 0)
        glfwSetWindowPos(glfwWindow(), settings_.window_x, settings_.window_y);
    glfwSwapInterval(0);  // pictures are drawn when something changes, not at the screen's rate
    makeShortcuts();
    makePanels();
    placePanels();
}

ViewerWindow::~ViewerWindow() = default;

void ViewerWindow::makeShortcuts() {
    const auto flips = [this](bool ViewerSettings::*field) {
        return [this, field] { flip(field); };
    };
    shortcuts_ = {
        {GLFW_KEY_F, "F", "show everything", [this] { fit(); }},
        {GLFW_KEY_T, "T", "from above",
         [this] {
             camera_.lookDown();
             sceneChanged();
         }},
        {GLFW_KEY_C, "C", "follow the camera",
         [this] {
             follow_camera_ = !follow_camera_;
             say(follow_camera_ ? "following the camera" : "no longer following the camera");
             sceneChanged();
         }},
        {GLFW_KEY_P, "P", "points", flips(&ViewerSettings::points)},
        {GLFW_KEY_O, "O", "octree", flips(&ViewerSettings::octree)},
        {GLFW_KEY_G, "G", "2-D grid", flips(&ViewerSettings::grid)},
        {GLFW_KEY_K, "K", "keyframes", flips(&ViewerSettings::keyframes)},
        {GLFW_KEY_V, "V", "covisibility", flips(&ViewerSettings::covisibility)},
        {GLFW_KEY_L, "L", "loops", flips(&ViewerSettings::loops)},
        {GLFW_KEY_R, "R", "true trajectory", flips(&ViewerSettings::truth)},
        {GLFW_KEY_E, "E", "errors", flips(&ViewerSettings::errors)},
        {GLFW_KEY_X, "X", "cut the ceiling off", flips(&ViewerSettings::cut_ceiling)},
        {GLFW_KEY_H, "H", "colours by height",
         [this] {
             settings_.colors = settings_.colors == "height" ? "camera" : "height";
             view_panel_->refresh();
             sceneChanged();
         }},
        {GLFW_KEY_M, "M", "measure a distance",
         [this] {
             measuring_ = !measuring_;
             measured_.clear();
             scene_->markPoints({}, 0);
             say(measuring_ ? "click two points" : " ");
             sceneChanged();
         }},
        {GLFW_KEY_SPACE, "Space", "replay, or stop it",
         [this] { time_panel_->on_play(!playing_); }},
        {GLFW_KEY_LEFT, "Left", "one keyframe back", [this] { stepKeyframe(-1); }},
        {GLFW_KEY_RIGHT, "Right", "one keyframe on", [this] { stepKeyframe(1); }},
        {GLFW_KEY_END, "End", "the whole run", [this] { moveTo(std::nullopt); }},
        {GLFW_KEY_S, "S", "screenshot", [this] { takeScreenshot(); }},
        {GLFW_KEY_TAB, "Tab", "hide or show the panels", [this] { togglePanels(); }},
        {GLFW_KEY_F1, "? or F1", "this list", [this] { toggleHelp(); }},
        {GLFW_KEY_Q, "Q", "quit", [this] { glfwSetWindowShouldClose(glfwWindow(), 1); }},
    };
}

void ViewerWindow::makePanels() {
    view_panel_ = new ViewPanel(this, settings_, [this] { sceneChanged(); });
    picture_panel_ = new PicturePanel(this);
    plot_panel_ = new PlotPanel(this);
    time_panel_ = new TimePanel(this);
    help_panel_ = new HelpPanel(this, shortcuts_);
    help_panel_->setVisible(false);
    time_panel_->on_move = [this](float share) {
        const auto [first, last] = timeSpan(scene_->run());
        if (share >= 1) {
            moveTo(std::nullopt);
        } else {
            moveTo(first + share * (last - first));
        }
    };
    time_panel_->on_play = [this](bool play) {
        const auto [first, last] = timeSpan(scene_->run());
        playing_ = play && last > first && !live_;
        if (playing_ && !now_s_) moveTo(first);
        last_advance_ = Clock::now();
        showTime();
    };
    view_panel_->setVisible(settings_.view_panel);
    picture_panel_->setVisible(settings_.image_panel);
    plot_panel_->setVisible(settings_.plot_panel);
    time_panel_->setVisible(settings_.time_panel);
}

/** Panels keep to the window's edges. */
void ViewerWindow::placePanels() {
    time_panel_->fitInto(width() - 2 * margin_px);
    performLayout();
    view_panel_->setPosition({margin_px, margin_px});
    plot_panel_->setPosition({margin_px, view_panel_->height() + 2 * margin_px});
    picture_panel_->setPosition({width() - picture_panel_->width() - margin_px, margin_px});
    time_panel_->setPosition({margin_px, height() - time_panel_->height() - margin_px});
    help_panel_->center();
    panels_changed_ = true;
}

void ViewerWindow::togglePanels() {
    const bool show = !view_panel_->visible();
    for (nanogui::Window* panel : std::initializer_list<nanogui::Window*>{
             view_panel_, picture_panel_, plot_panel_, time_panel_}) {
        panel->setVisible(show);
    }
    panels_changed_ = true;
}

void ViewerWindow::toggleHelp() {
    help_panel_->setVisible(!help_panel_->visible());
    moveWindowToFront(help_panel_);
    panels_changed_ = true;
}

ViewerSettings ViewerWindow::settings() const {
    ViewerSettings settings = settings_;
    auto* window = const_cast<ViewerWindow*>(this)->glfwWindow();
    glfwGetWindowSize(window, &settings.window_width, &settings.window_height);
    glfwGetWindowPos(window, &settings.window_x, &settings.window_y);
    settings.view_panel = view_panel_->visible();
    settings.image_panel = picture_panel_->visible();
    settings.plot_panel = plot_panel_->visible();
    settings.time_panel = time_panel_->visible();
    return settings;
}

void ViewerWindow::open(RunData run) {
    const bool has_recording = !run.rawlog.empty();
    loader_.reset();
    if (has_recording) {
        loader_ = std::make_unique<RecordingLoader>(run.rawlog, run.keyframes, run.trajectory);
    }
    all_read_ = !has_recording;
    follow_camera_ = false;
    time_panel_->setReplayVisible(true);
    placePanels();
    scene_->show(std::move(run));
    now_s_.reset();
    select(std::nullopt);
    fit();
    showPlots();
    showTime();
}

bool ViewerWindow::settled() const {
    return !live_ && all_read_ && renderer_->complete() && !scene_changed_ && !panels_changed_ &&
           !picture_changed_;
}

double ViewerWindow::update() {
    const auto start = Clock::now();
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
    panels_changed_ |= mLastInteraction != last_drawn_interaction_ && drag_button_ < 0;
    if (panels_changed_ || picture_changed_) {
        drawAll();
        restAfterDrawing(start);
    }
    if (live_) return reading_wait_s;
    if (playing_ || !renderer_->complete()) return busy_wait_s;
    return all_read_ ? idle_wait_s : reading_wait_s;
}

/** Opaque panels can be copied over the scene; drawing them anew for each picture of a moving scene
 *  would take as long as the scene. */
void ViewerWindow::styleTheme() {
    theme()->mWindowDropShadowSize = 0;
    theme()->mWindowCornerRadius = 0;
    theme()->mWindowFillFocused = theme()->mWindowFillUnfocused = nanogui::Color(45, 48, 54, 255);
}

void ViewerWindow::drawPanels() {
    panels_->resize(mFBSize);
    panels_->bind();
    glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    drawWidgets();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    last_drawn_interaction_ = mLastInteraction;
    panels_changed_ = false;
}

/** Draws to the back buffer. */
void ViewerWindow::compose() {
    if (panels_changed_) drawPanels();
    picture_changed_ = false;
    renderer_->copyToWindow();
    const float scale = pixelRatio();
    for (const nanogui::Widget* panel : children()) {
        if (!panel->visible()) continue;
        const Eigen::Vector2i corner = (scale * panel->position().cast<float>()).cast<int>();
        const Eigen::Vector2i size = (scale * panel->size().cast<float>()).cast<int>();
        panels_->copyToWindow(cv::Rect(corner.x(), corner.y(), size.x(), size.y()));
    }
}

void ViewerWindow::drawAll() {
    compose();
    glfwSwapBuffers(glfwWindow());
}

SceneView ViewerWindow::sceneView() {
    if (follow_camera_) {
        const auto [first, last] = timeSpan(scene_->run());
        if (const auto pose = poseNear(scene_->run().trajectory, now_s_.value_or(last)))
            camera_.target = pose->t;
    }
    scene_->markNow(now_s_);
    SceneView view = scene_->viewAt(now_s_, settings_);
    view.camera = camera_;
    view.size_px = mFBSize;
    return view;
}

void ViewerWindow::takeRecording() {
    if (!loader_ || all_read_) return;
    RecordingLoader::News news = loader_->take();
    all_read_ = news.finished;
    const bool anything = news.camera || news.truth;
    const bool truth = news.truth.has_value();
    if (anything) {
        scene_->add(std::move(news));
        showPictures();
        sceneChanged();
    }
    if (truth) showPlots();
}

void ViewerWindow::advanceReplay() {
    if (!playing_) return;
    const auto now = Clock::now();
    const std::chrono::duration<double> passed = now - std::exchange(last_advance_, now);
    const double stamp_s = *now_s_ + passed.count();
    if (stamp_s >= timeSpan(scene_->run()).second) {
        playing_ = false;
        moveTo(std::nullopt);
    } else {
        moveTo(stamp_s);
    }
}

void ViewerWindow::moveTo(std::optional<double> stamp_s) {
    if (live_) return;  // the present moment is shown
    now_s_ = stamp_s;
    if (!stamp_s) playing_ = false;
    if (stamp_s) select(std::nullopt);
    showPictures();
    showTime();
    sceneChanged();
}

void ViewerWindow::stepKeyframe(int step) {
    const Trajectory& keyframes = scene_->run().keyframes;
    if (keyframes.empty()) return;
    const int last = static_cast<int>(keyframes.size()) - 1;
    const int shown = selected_ ? static_cast<int>(*selected_)
                      : now_s_  ? static_cast<int>(replayAt(scene_->run(), *now_s_).keyframes) - 1
                                : last;
    moveTo(keyframes[std::clamp(shown + step, 0, last)].stamp_s);
}

/** The selected keyframe, or the last one by now. */
void ViewerWindow::showPictures() {
    const RunData& run = scene_->run();
    const std::size_t by_now = now_s_ ? replayAt(run, *now_s_).keyframes : run.keyframes.size();
    if (by_now == 0) return;
    const std::size_t keyframe = selected_.value_or(by_now - 1);
    const KeyframePicture* picture = scene_->picture(keyframe);
    const std::string without = run.rawlog.empty() ? "no recording" : "not yet read";
    picture_panel_->color().show(picture ? decoded(picture->color_jpeg) : cv::Mat3b(), without);
    picture_panel_->depth().show(picture ? decoded(picture->depth_jpeg) : cv::Mat3b(), without);
    picture_panel_->say(formatted("keyframe %zu of %zu, %.2f s", keyframe, run.keyframes.size(),
                                  run.keyframes[keyframe].stamp_s - timeSpan(run).first));
    panels_changed_ = true;
}

void ViewerWindow::showPlots() {
    std::vector<float> landmarks, errors_cm;
    for (const FrameNote& frame : scene_->run().frames)
        landmarks.push_back(frame.lost ? NAN : static_cast<float>(frame.inliers));
    if (scene_->truth()) {
        for (const auto& error : scene_->truth()->errors)
            errors_cm.push_back(static_cast<float>(100 * (error.estimate - error.truth).norm()));
    }
    plot_panel_->upper().name("tracked landmarks", "");
    plot_panel_->upper().show(std::move(landmarks));
    plot_panel_->lower().name(errors_cm.empty() ? "error: no truth" : "error", " cm");
    plot_panel_->lower().show(std::move(errors_cm));
    panels_changed_ = true;
}

void ViewerWindow::showTime() {
    const auto [first, last] = timeSpan(scene_->run());
    const double span_s = last - first, now_s = now_s_.value_or(last) - first;
    const float share = span_s > 0 ? static_cast<float>(now_s / span_s) : 1;
    time_panel_->show(share, playing_, formatted("%.1f / %.1f s", now_s, span_s));
    plot_panel_->upper().setCursor(now_s_ ? share : -1);
    plot_panel_->lower().setCursor(now_s_ ? share : -1);
    panels_changed_ = true;
}

void ViewerWindow::say(const std::string& text) {
    time_panel_->say(text);
    panels_changed_ = true;
}

/** Share of the window's width and height that panels at its edges leave free. */
Eigen::Vector2d ViewerWindow::freeShare() const {
    const auto covered = [](const nanogui::Widget* panel, int extent) {
        return panel->visible() ? 2. * (extent + margin_px) : 0;
    };
    const double x = std::max(covered(view_panel_, view_panel_->width()),
                              covered(picture_panel_, picture_panel_->width()));
    const double y = covered(time_panel_, time_panel_->height());
    return {std::max(0.3, 1 - x / width()), std::max(0.3, 1 - y / height())};
}

void ViewerWindow::fit() {
    if (!scene_->box().isEmpty()) camera_.frame(scene_->box(), mFBSize, freeShare());
    follow_camera_ = false;
    sceneChanged();
}

void ViewerWindow::flip(bool ViewerSettings::*field) {
    settings_.*field = !(settings_.*field);
    view_panel_->refresh();
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
    if (measuring_) return measureAt(pixel);
    if (live_) return;
    const RunData& run = scene_->run();
    const std::size_t shown = now_s_ ? replayAt(run, *now_s_).keyframes : run.keyframes.size();
    select(keyframeAt(run.keyframes, settings_.keyframes ? shown : 0, pixel, camera_, mFBSize));
}

void ViewerWindow::lookAt(const Eigen::Vector2d& pixel) {
    const auto point = surfaceUnder(pixel);
    if (!point) return;
    camera_.distance_m = (camera_.eye() - *point).norm();
    camera_.target = *point;
    sceneChanged();
}

void ViewerWindow::measureAt(const Eigen::Vector2d& pixel) {
    const auto point = surfaceUnder(pixel);
    if (!point) return say("nothing there to measure");
    if (measured_.size() == 2) measured_.clear();
    measured_.push_back(*point);
    scene_->markPoints(measured_, 0.01 * camera_.distance_m);
    if (measured_.size() == 1) {
        say(formatted("from (%.3f, %.3f, %.3f) m; click the other point", point->x(), point->y(),
                      point->z()));
    } else {
        const Eigen::Vector3d d = measured_[1] - measured_[0];
        say(formatted("distance %.3f m: %.3f m on the level, %.3f m in height", d.norm(),
                      d.head<2>().norm(), std::abs(d.z())));
    }
    sceneChanged();
}

void ViewerWindow::takeScreenshot() {
    try {
        const std::string folder = scene_->run().folder;
        const std::string path = freeScreenshotName(folder.empty() ? "." : folder);
        saveScreenshot(path);
        say("saved " + path);
    } catch (const Error& e) {
        say(e.what());
    }
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

bool ViewerWindow::mouseButtonEvent(const Eigen::Vector2i& p, int button, bool down,
                                    int modifiers) {
    if (down && nanogui::Screen::mouseButtonEvent(p, button, down, modifiers)) return true;
    if (down) {
        drag_button_ = button;
        drag_start_ = p;
        return true;
    }
    const bool was_dragging = std::exchange(drag_button_, -1) >= 0;
    if (!was_dragging) return nanogui::Screen::mouseButtonEvent(p, button, down, modifiers);
    if (button != GLFW_MOUSE_BUTTON_LEFT || (p - drag_start_).norm() > click_slack_px) return true;
    const Eigen::Vector2d pixel = pixelRatio() * p.cast<double>();
    const auto now = Clock::now();
    const std::chrono::duration<double> since = now - std::exchange(last_click_, now);
    if (since.count() < double_click_s && !measuring_) {
        lookAt(pixel);
    } else {
        click(pixel);
    }
    return true;
}

bool ViewerWindow::mouseMotionEvent(const Eigen::Vector2i& p, const Eigen::Vector2i& rel,
                                    int button, int modifiers) {
    if (drag_button_ < 0) return nanogui::Screen::mouseMotionEvent(p, rel, button, modifiers);
    const Eigen::Vector2d motion = pixelRatio() * rel.cast<double>();
    const bool moves = drag_button_ != GLFW_MOUSE_BUTTON_LEFT || (modifiers & GLFW_MOD_SHIFT);
    if ((p - drag_start_).norm() <= click_slack_px && !moves) return true;
    if (moves) {
        camera_.pan(motion, mFBSize.y());
        follow_camera_ = false;
    } else {
        camera_.orbit(motion);
    }
    sceneChanged();
    return true;
}

bool ViewerWindow::scrollEvent(const Eigen::Vector2i& p, const Eigen::Vector2f& rel) {
    if (nanogui::Screen::scrollEvent(p, rel)) return true;
    camera_.zoom(std::pow(zoom_a_notch, static_cast<double>(rel.y())),
                 pixelRatio() * p.cast<double>(), mFBSize);
    sceneChanged();
    return true;
}

bool ViewerWindow::keyboardEvent(int key, int, int action, int) {
    if (action == GLFW_RELEASE) return false;
    for (const Shortcut& shortcut : shortcuts_) {
        if (shortcut.key != key) continue;
        shortcut.act();
        return true;
    }
    return false;
}

bool ViewerWindow::keyboardCharacterEvent(unsigned int codepoint) {
    if (codepoint != '?') return false;
    toggleHelp();
    return true;
}

bool ViewerWindow::resizeEvent(const Eigen::Vector2i&) {
    placePanels();
    sceneChanged();
    return true;
}

}  // namespace rgbd_graphslam
