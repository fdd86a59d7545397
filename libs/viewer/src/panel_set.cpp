#include "panel_set.h"

#include <algorithm>

namespace rgbd_graphslam {
namespace {

constexpr int margin_px = 8;
/** However small the window is, the scene gets this share of it. */
constexpr double least_free = 0.3;

/** What a panel takes of both sides, so that the centre stays the centre. */
double covered(const nanogui::Widget& panel, int extent_px) {
    return panel.visible() ? 2. * (extent_px + margin_px) : 0;
}

}  // namespace

PanelSet::PanelSet(nanogui::Screen& window, ViewerSettings& settings,
                   const std::vector<Shortcut>& shortcuts, std::function<void()> settings_changed)
    : window_(window),
      view_(new ViewPanel(&window, settings, settings_changed)),
      pictures_(new PicturePanel(&window, settings, settings_changed)),
      plots_(new PlotPanel(&window)),
      time_(new TimePanel(&window)),
      help_(new HelpPanel(&window, shortcuts)),
      files_(new ExportPanel(&window)) {
    view_->setVisible(settings.view_panel);
    pictures_->setVisible(settings.image_panel);
    plots_->setVisible(settings.plot_panel);
    time_->setVisible(settings.time_panel);
    help_->setVisible(false);
    files_->setVisible(false);
}

void PanelSet::place() {
    time_->fitInto(window_.width() - 2 * margin_px);
    window_.performLayout();
    view_->setPosition({margin_px, margin_px});
    plots_->setPosition({margin_px, view_->height() + 2 * margin_px});
    pictures_->setPosition({window_.width() - pictures_->width() - margin_px, margin_px});
    time_->setPosition({margin_px, window_.height() - time_->height() - margin_px});
    help_->center();
    files_->center();
}

void PanelSet::toggle() {
    const bool show = !view_->visible();
    for (nanogui::Window* panel :
         std::initializer_list<nanogui::Window*>{view_, pictures_, plots_, time_}) {
        panel->setVisible(show);
    }
}

void PanelSet::toggle(nanogui::Window& panel) {
    panel.setVisible(!panel.visible());
    window_.moveWindowToFront(&panel);
}

Eigen::Vector2d PanelSet::freeShare() const {
    const double x =
        std::max(covered(*view_, view_->width()), covered(*pictures_, pictures_->width()));
    const double y = covered(*time_, time_->height());
    return {std::max(least_free, 1 - x / window_.width()),
            std::max(least_free, 1 - y / window_.height())};
}

void PanelSet::store(ViewerSettings& settings) const {
    settings.view_panel = view_->visible();
    settings.image_panel = pictures_->visible();
    settings.plot_panel = plots_->visible();
    settings.time_panel = time_->visible();
}

}  // namespace rgbd_graphslam
