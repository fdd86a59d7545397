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
                   const std::vector<Shortcut>& shortcuts,
                   const std::function<void()>& settings_changed)
    : window_(window),
      wanted_{settings.view_panel, settings.image_panel, settings.plot_panel, settings.time_panel},
      view_(new ViewPanel(&window, settings, settings_changed)),
      pictures_(new PicturePanel(&window, settings, settings_changed)),
      plots_(new PlotPanel(&window)),
      time_(new TimePanel(&window)),
      help_(new HelpPanel(&window, shortcuts)),
      files_(new ExportPanel(&window)) {
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
    showWhatFits();
}

void PanelSet::showWhatFits() {
    time_->setVisible(wanted_.time);
    const int bottom = window_.height() - (wanted_.time ? time_->height() + margin_px : 0);
    const auto fits = [&](const nanogui::Widget& panel) {
        return panel.position().y() + panel.height() + margin_px <= bottom;
    };
    view_->setVisible(wanted_.view && fits(*view_));
    plots_->setVisible(wanted_.plots && fits(*plots_));
    const int left_end = std::max(view_->width(), plots_->width()) + margin_px;
    pictures_->setVisible(wanted_.pictures && fits(*pictures_) &&
                          pictures_->position().x() > left_end + margin_px);
}

void PanelSet::toggle() {
    const bool show = !wanted_.view;
    wanted_ = {show, show, show, show};
    showWhatFits();
}

void PanelSet::toggle(nanogui::Window& panel) {
    panel.setVisible(!panel.visible());
    window_.moveWindowToFront(&panel);
}

std::vector<nanogui::Widget*> PanelSet::liveWidgets() {
    return {&pictures_->label(), &pictures_->color(), &pictures_->depth(), &plots_->landmarks(),
            &plots_->times(),    &plots_->errors(),   &time_->news()};
}

Eigen::Vector2d PanelSet::freeShare() const {
    const double x =
        std::max(covered(*view_, view_->width()), covered(*pictures_, pictures_->width()));
    const double y = covered(*time_, time_->height());
    return {std::max(least_free, 1 - x / window_.width()),
            std::max(least_free, 1 - y / window_.height())};
}

void PanelSet::store(ViewerSettings& settings) const {
    settings.view_panel = wanted_.view;
    settings.image_panel = wanted_.pictures;
    settings.plot_panel = wanted_.plots;
    settings.time_panel = wanted_.time;
}

}  // namespace rgbd_graphslam
