/** The panels of a window and their places. */
#pragma once
#include <Eigen/Core>
#include <functional>
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
    /** Whether one of these is open. */
    bool middleIsOpen() const { return help_->visible() || files_->visible(); }
    /** Those that show something else with every frame of a running SLAM. */
    std::vector<nanogui::Widget*> liveWidgets();
    /** Share of the window's width and height that the panels leave free round its centre. */
    Eigen::Vector2d freeShare() const;
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
};

}  // namespace rgbd_graphslam
