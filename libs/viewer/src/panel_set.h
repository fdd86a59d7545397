/** The panels of a window and their places. */
#pragma once
#include <Eigen/Core>
#include <functional>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "panels.h"

namespace rgbd_graphslam {

/** Panels keep to the window's edges; one that would cover others in a small window is not shown.
 * The window owns them. */
class PanelSet {
  public:
    /** \param settings_changed after one of the panels' switches has changed a setting */
    PanelSet(nanogui::Screen& window, ViewerSettings& settings,
             const std::vector<Shortcut>& shortcuts, const std::function<void()>& settings_changed);

    /** To be called when the window or a panel has another size. */
    void place();
    /** Hides all that stay open, or shows them again. */
    void toggle();
    /** Opens or closes one of those that stand in the middle. */
    void toggle(nanogui::Window& panel);
    /** Closes those. \return whether one was open */
    bool closeMiddle();
    /** Whether a panel is open that may lie over others. */
    bool anyOverOthers() const { return help_->visible() || files_->visible() || hint_->visible(); }
    /** Shows a tooltip beside the mouse, or none. \return whether something changed */
    bool hint(const std::string& text, const Eigen::Vector2i& mouse);
    /** Grays out what a run cannot show. */
    void offer(const RunContents& contents);
    /** Those that show something else with every frame of a running SLAM. */
    std::vector<nanogui::Widget*> liveWidgets();
    /** The part of the window between the panels, in its own units. */
    cv::Rect freeArea() const;
    /** Which are to be open. */
    void store(ViewerSettings& settings) const;

    ViewPanel& view() { return *view_; }
    PicturePanel& pictures() { return *pictures_; }
    PlotPanel& plots() { return *plots_; }
    TimePanel& time() { return *time_; }
    HelpPanel& help() { return *help_; }
    ExportPanel& files() { return *files_; }

  private:
    /** Which are to be open where there is room. */
    struct Wanted {
        bool view, pictures, plots, time;
    };
    void showWhatFits();

    nanogui::Screen& window_;
    Wanted wanted_;
    ViewPanel* view_;
    PicturePanel* pictures_;
    PlotPanel* plots_;
    TimePanel* time_;
    HelpPanel* help_;
    ExportPanel* files_;
    HintPanel* hint_;
};

}  // namespace rgbd_graphslam
