/** The viewer's window: 3-D view, panels, mouse and keys. */
#pragma once
#include <nanogui/nanogui.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "panels.h"
#include "rgbd_graphslam/viewer/live_run.h"
#include "rgbd_graphslam/viewer/orbit_camera.h"
#include "rgbd_graphslam/viewer/recording_loader.h"
#include "rgbd_graphslam/viewer/run_data.h"
#include "run_scene.h"
#include "scene_renderer.h"

namespace rgbd_graphslam {

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

    void makeShortcuts();
    void makePanels();
    void placePanels();
    void togglePanels();
    void toggleHelp();

    void drawAll() override;
    void compose();
    void drawPanels();
    void styleTheme();
    SceneView sceneView();
    void takeRecording();
    void takeLive();
    void showLive();
    void restAfterDrawing(Clock::time_point start);
    void showLivePictures(const LiveFrame& frame);
    void showLivePlots();
    void endLive();
    void advanceReplay();
    void moveTo(std::optional<double> stamp_s);
    void stepKeyframe(int step);
    void showPictures();
    void showPlots();
    void showTime();
    void say(const std::string& text);

    Eigen::Vector2d freeShare() const;
    void fit();
    void click(const Eigen::Vector2d& pixel);
    void lookAt(const Eigen::Vector2d& pixel);
    void measureAt(const Eigen::Vector2d& pixel);
    void select(std::optional<std::size_t> keyframe);
    void takeScreenshot();
    std::optional<Eigen::Vector3d> surfaceUnder(const Eigen::Vector2d& pixel) const;
    void flip(bool ViewerSettings::*field);
    void sceneChanged() { scene_changed_ = true; }

    ViewerSettings settings_;
    std::vector<Shortcut> shortcuts_;
    std::unique_ptr<SceneRenderer> renderer_;
    std::unique_ptr<RunScene> scene_;
    std::unique_ptr<RenderTarget> panels_;
    std::unique_ptr<RecordingLoader> loader_;
    bool all_read_ = true;
    std::unique_ptr<LiveRun> live_;  // while a run is followed
    std::string live_folder_;
    bool live_is_new_ = false;  // something to show has come
    Clock::time_point next_live_picture_;

    OrbitCamera camera_;
    bool follow_camera_ = false, measuring_ = false;
    std::vector<Eigen::Vector3d> measured_;
    std::optional<std::size_t> selected_;
    std::optional<double> now_s_;  // nothing: the whole run
    bool playing_ = false;
    Clock::time_point last_advance_;

    bool scene_changed_ = true;
    double last_drawn_interaction_ = -1;
    bool panels_changed_ = true, picture_changed_ = true;
    int drag_button_ = -1;
    Eigen::Vector2i drag_start_ = Eigen::Vector2i::Zero();
    Clock::time_point last_click_;

    ViewPanel* view_panel_ = nullptr;
    PicturePanel* picture_panel_ = nullptr;
    PlotPanel* plot_panel_ = nullptr;
    TimePanel* time_panel_ = nullptr;
    HelpPanel* help_panel_ = nullptr;
};

}  // namespace rgbd_graphslam
