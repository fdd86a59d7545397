/** The viewer's window: 3-D view, panels, mouse and keys. */
#pragma once
#include <nanogui/nanogui.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "idle_time.h"
#include "panel_set.h"
#include "rgbd_graphslam/mapping/orbit_camera.h"
#include "rgbd_graphslam/viewer/cpu_budget.h"
#include "rgbd_graphslam/viewer/live_run.h"
#include "rgbd_graphslam/viewer/measuring.h"
#include "rgbd_graphslam/viewer/mouse_gesture.h"
#include "rgbd_graphslam/viewer/recording_loader.h"
#include "rgbd_graphslam/viewer/replay_clock.h"
#include "rgbd_graphslam/viewer/run_data.h"
#include "run_scene.h"
#include "scene_renderer.h"

namespace rgbd_graphslam {

/** Drawing is in viewer_window.cpp, keys and mouse in viewer_input.cpp, what they set off in
 *  viewer_actions.cpp, and following a run in viewer_live.cpp. */
class ViewerWindow : public nanogui::Screen {
  public:
    ViewerWindow(const ViewerSettings& settings, const std::string& title);
    ~ViewerWindow() override;

    /** Shows a finished run and starts to read its recording. */
    void open(RunData run);
    /** Shows the run that writes to a folder while it goes on, and its result when it has ended. */
    void follow(const std::string& folder, std::filesystem::file_time_type since);

    /** Takes in what has happened and draws where something changed.
     *  \return how long it may wait for the next event, s */
    double update();
    /** Whether everything is read and the picture is complete. */
    bool settled() const;

    /** Whether a frame of the run that is followed has been on the screen, or its result. */
    bool showsRun() const { return shows_run_; }

    /** Writes the window as it is to a PNG. \throws Error when it cannot be written */
    void saveScreenshot(const std::string& path);
    /** Draws the view from all sides as fast as it can. \return pictures a second */
    double spin(double seconds);
    std::size_t points() const { return renderer_->points(); }
    std::size_t pointsDrawn() const { return renderer_->pointsDrawn(); }

    /** With the window's present place. */
    ViewerSettings settings() const;

    bool mouseButtonEvent(const Eigen::Vector2i& p, int button, bool down, int modifiers) override;
    bool mouseMotionEvent(const Eigen::Vector2i& p, const Eigen::Vector2i& rel, int button,
                          int modifiers) override;
    bool scrollEvent(const Eigen::Vector2i& p, const Eigen::Vector2f& rel) override;
    bool keyboardEvent(int key, int scancode, int action, int modifiers) override;
    bool keyboardCharacterEvent(unsigned int codepoint) override;
    bool resizeEvent(const Eigen::Vector2i& size) override;

  private:
    using Clock = std::chrono::steady_clock;

    void drawAll() override;
    void compose();
    void drawOverlay();
    double updateHint();
    void drawPanels();
    void drawLivePanels();
    void styleTheme();
    SceneView sceneView();
    void takeRecording();
    void sceneChanged() { scene_changed_ = true; }
    void panelsChanged() { panels_changed_ = true; }

    std::vector<Shortcut> viewShortcuts();
    std::vector<Shortcut> toolShortcuts();
    void connectPanels();

    void placePanels();
    void showPictures();
    void showTime();
    void say(const std::string& text);
    void showAtOnce(const std::string& text);
    void advanceReplay();
    void moveTo(std::optional<double> stamp_s);
    void play(bool play);
    void stepKeyframe(int step);
    /** How many keyframes are shown. */
    std::size_t keyframesByNow() const;
    /** The selected one, or the last one by now. */
    std::optional<std::size_t> keyframeInPanel() const;
    bool hasPictureForPanel() const;
    void fit();
    void lookDown();
    void toggleFollowing();
    void toggleColors();
    void flip(bool ViewerSettings::*field);
    void click(const Eigen::Vector2d& pixel);
    void lookAt(const Eigen::Vector2d& pixel);
    void toggleMeasuring();
    void measureAt(const Eigen::Vector2d& pixel);
    void select(std::optional<std::size_t> keyframe);
    std::optional<Eigen::Vector3d> surfaceUnder(const Eigen::Vector2d& pixel) const;
    void escape();
    void takeScreenshot();
    void exportMap(ExportFormat format);
    /** Where files are put that the user asks for. */
    std::string outputFolder() const { return live_ ? live_folder_ : scene_->run().folder; }

    void takeLive();
    void showLive();
    void keepLiveBudget();
    double liveWait() const;
    void endLive();

    ViewerSettings settings_;
    std::vector<Shortcut> shortcuts_;
    std::unique_ptr<PanelSet> panels_;
    std::unique_ptr<SceneRenderer> renderer_;
    std::unique_ptr<RunScene> scene_;
    std::unique_ptr<RenderTarget> panel_layer_;
    std::unique_ptr<RecordingLoader> loader_;
    bool all_read_ = true, camera_known_ = false;
    std::unique_ptr<LiveRun> live_;  // while a run is followed
    std::string live_folder_;
    bool live_panels_changed_ = false;  // what panels show of the run
    bool shows_run_ = false;
    CpuBudget live_budget_{1, 0};
    IdleTime idle_time_;

    OrbitCamera camera_;
    MouseGesture mouse_;
    Measuring measuring_;
    ReplayClock replay_;
    bool follow_camera_ = false;
    std::optional<std::size_t> selected_;

    bool scene_changed_ = true, panels_changed_ = true, picture_changed_ = true;
    double last_drawn_interaction_ = -1;
    double compose_s_ = 0;  // what a picture takes beside its scene
};

}  // namespace rgbd_graphslam
