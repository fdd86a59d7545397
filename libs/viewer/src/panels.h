/** The viewer's panels: windows within the window. */
#pragma once
#include <nanogui/nanogui.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "rgbd_graphslam/viewer/map_export.h"
#include "rgbd_graphslam/viewer/view_switches.h"
#include "rgbd_graphslam/viewer/viewer_settings.h"
#include "widgets.h"

namespace rgbd_graphslam {

/** A key and what it does. */
struct Shortcut {
    int key;  // GLFW's
    const char* name;
    const char* meaning;
    std::function<void()> act;
};

/** Switches; each writes its setting and then calls `changed`. */
class ViewPanel : public nanogui::Window {
  public:
    ViewPanel(nanogui::Widget* screen, ViewerSettings& settings, std::function<void()> changed);

    /** Grays out what a run cannot show; tooltips tell why. */
    void offer(const RunContents& contents);
    /** Shows settings that were changed elsewhere. */
    void refresh();
    /** \param scale how many times longer than they are errors are drawn */
    void nameErrors(int scale);

  private:
    void addSwitch(const ViewSwitch& entry);

    ViewerSettings& settings_;
    std::function<void()> changed_;
    std::vector<std::pair<nanogui::CheckBox*, const ViewSwitch*>> switches_;
    nanogui::CheckBox *errors_ = nullptr, *by_height_ = nullptr;
    nanogui::Slider* point_size_ = nullptr;
};

/** Color and depth of a keyframe or of the live frame. */
class PicturePanel : public nanogui::Window {
  public:
    PicturePanel(nanogui::Widget* screen, ViewerSettings& settings, std::function<void()> changed);

    PictureWidget& color() { return *color_; }
    PictureWidget& depth() { return *depth_; }
    nanogui::Label& label() { return *label_; }
    void say(const std::string& text) { label_->setCaption(text); }
    /** Only live frames have features. */
    void setLive(bool live);

  private:
    nanogui::Label* label_;
    PictureWidget *color_, *depth_;
    nanogui::Widget* features_;
};

/** Curves over the frames of a run. */
class PlotPanel : public nanogui::Window {
  public:
    explicit PlotPanel(nanogui::Widget* screen);

    PlotWidget& landmarks() { return *landmarks_; }
    PlotWidget& times() { return *times_; }
    PlotWidget& errors() { return *errors_; }
    /** \param share of the width; outside [0, 1] hides it */
    void setCursor(float share);

  private:
    PlotWidget* addPlot(const char* title, const char* unit);

    PlotWidget *landmarks_, *times_, *errors_;
};

/** The slider that replays the run, and a line of news. */
class TimePanel : public nanogui::Window {
  public:
    explicit TimePanel(nanogui::Widget* screen);

    std::function<void(float share)> on_move = [](float) {};
    std::function<void(bool play)> on_play = [](bool) {};

    void fitInto(int width_px);
    void show(float share, bool playing, const std::string& time);
    nanogui::Label& news() { return *news_; }
    void say(const std::string& text) { news_->setCaption(text); }
    /** A live run has no time to choose. */
    void setReplayVisible(bool visible);

  private:
    nanogui::Widget* row_;
    nanogui::Button* play_;
    nanogui::Slider* slider_;
    nanogui::Label *time_, *news_;
};

/** All shortcuts and what the mouse does. */
class HelpPanel : public nanogui::Window {
  public:
    HelpPanel(nanogui::Widget* screen, const std::vector<Shortcut>& shortcuts);

    std::function<void()> on_close = [] {};
};

/** Which file to write the map to. */
class ExportPanel : public nanogui::Window {
  public:
    explicit ExportPanel(nanogui::Widget* screen);

    std::function<void(ExportFormat format)> on_export = [](ExportFormat) {};
    std::function<void()> on_close = [] {};
    /** Grays out what a run does not have; tooltips tell why. */
    void offer(const RunContents& contents);

  private:
    void add(const char* caption, ExportFormat format, bool ViewerSettings::*needed);

    std::vector<std::pair<nanogui::Button*, bool ViewerSettings::*>> buttons_;
};

/** The tooltip of the widget under the mouse. nanogui's own would lie outside of all panels, where
 *  only the scene is copied to the window. */
class HintPanel : public nanogui::Window {
  public:
    explicit HintPanel(nanogui::Widget* screen);

    /** \param text nothing hides it \return whether something changed */
    bool show(const std::string& text);

  private:
    nanogui::Label* label_;
};

}  // namespace rgbd_graphslam
