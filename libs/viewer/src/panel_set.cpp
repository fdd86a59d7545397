#include "panel_set.h"

#include <algorithm>

namespace rgbd_graphslam {
namespace {

constexpr int margin_px = 8;
/** However small the window is, the scene gets this share of it. */
constexpr double least_free = 0.3;

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
      files_(new ExportPanel(&window)),
      hint_(new HintPanel(&window)) {
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

cv::Rect PanelSet::freeArea() const {
    const int width = window_.width(), height = window_.height();
    int left = 0, right = width, bottom = height;
    for (const nanogui::Widget* panel : std::initializer_list<nanogui::Widget*>{view_, plots_}) {
        if (panel->visible())
            left = std::max(left, panel->position().x() + panel->width() + margin_px);
    }
    if (pictures_->visible()) right = pictures_->position().x() - margin_px;
    if (time_->visible()) bottom = time_->position().y() - margin_px;
    if (right - left < least_free * width) left = 0, right = width;
    if (bottom < least_free * height) bottom = height;
    return {left, 0, right - left, bottom};
}

bool PanelSet::closeMiddle() {
    const bool was_open = help_->visible() || files_->visible();
    help_->setVisible(false);
    files_->setVisible(false);
    return was_open;
}

bool PanelSet::hint(const std::string& text, const Eigen::Vector2i& mouse) {
    if (!hint_->show(text)) return false;
    if (!hint_->visible()) return true;
    constexpr int below_px = 20;
    window_.performLayout();
    const int x = std::min(mouse.x(), window_.width() - hint_->width() - margin_px);
    const bool fits = mouse.y() + below_px + hint_->height() < window_.height();
    const int y = fits ? mouse.y() + below_px : mouse.y() - hint_->height() - margin_px;
    hint_->setPosition({std::max(0, x), std::max(0, y)});
    window_.moveWindowToFront(hint_);
    return true;
}

void PanelSet::offer(const RunContents& contents) {
    view_->offer(contents);
    files_->offer(contents);
}

void PanelSet::store(ViewerSettings& settings) const {
    settings.view_panel = wanted_.view;
    settings.image_panel = wanted_.pictures;
    settings.plot_panel = wanted_.plots;
    settings.time_panel = wanted_.time;
}

}  // namespace rgbd_graphslam
