#include "panels.h"

#include <nanogui/entypo.h>

#include <opencv2/core.hpp>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/viewer/keyframe_view.h"
#include "scene_colors.h"

namespace rgbd_graphslam {
namespace {

/** All panels at the sides are as wide as this and their margins. */
constexpr int content_px = 248, picture_height_px = 186, plot_height_px = 76;
constexpr int line_px = 18, switch_height_px = 20, swatch_width_px = 18, swatch_height_px = 3;
constexpr float largest_point_px = 10;

nanogui::Widget* column(nanogui::Widget* parent, int spacing_px) {
    parent->setLayout(new nanogui::BoxLayout(nanogui::Orientation::Vertical,
                                             nanogui::Alignment::Fill, 8, spacing_px));
    return parent;
}

nanogui::Widget* row(nanogui::Widget* parent, int spacing_px) {
    auto* row = new nanogui::Widget(parent);
    row->setLayout(new nanogui::BoxLayout(nanogui::Orientation::Horizontal,
                                          nanogui::Alignment::Middle, 0, spacing_px));
    return row;
}

void addLabel(nanogui::Widget* parent, const char* text, const Rgba& color) {
    auto* label = new nanogui::Label(parent, text);
    label->setColor(nanogui::Color(color[0], color[1], color[2], color[3]));
}

std::string withKey(const std::string& about, const std::string& key) {
    return key.empty() ? about : about + " Key: " + key;
}

/** For windows that stand in the way of others. */
void addCloseButton(nanogui::Window* window, const std::function<void()>& close) {
    auto* button = new nanogui::Button(window->buttonPanel(), "", ENTYPO_ICON_CROSS);
    button->setCallback(close);
    button->setTooltip("Close. Key: Esc");
}

}  // namespace

ViewPanel::ViewPanel(nanogui::Widget* screen, ViewerSettings& settings,
                     std::function<void()> changed)
    : nanogui::Window(screen, "View"), settings_(settings), changed_(std::move(changed)) {
    column(this, 1);
    for (const ViewSwitch& entry : viewSwitches()) addSwitch(entry);
    by_height_ = new nanogui::CheckBox(this, "color by height", [this](bool on) {
        settings_.colors = on ? "height" : "camera";
        changed_();
    });
    by_height_->setTooltip("Points, mesh and octree in colors of their height. Key: H");
    new nanogui::Label(this, "point size");
    point_size_ = new nanogui::Slider(this);
    point_size_->setFixedWidth(content_px);
    point_size_->setRange({1, largest_point_px});
    point_size_->setCallback([this](float px) {
        settings_.point_size_px = px;
        changed_();
    });
    offer({});
    refresh();
}

void ViewPanel::addSwitch(const ViewSwitch& entry) {
    nanogui::Widget* line = row(this, 0);
    auto* box = new nanogui::CheckBox(line, entry.name, [this, &entry](bool on) {
        settings_.*entry.field = on;
        changed_();
    });
    box->setFixedSize({content_px - swatch_width_px, switch_height_px});
    if (entry.color) new ColorWidget(line, {swatch_width_px, swatch_height_px}, *entry.color);
    switches_.emplace_back(box, &entry);
    if (entry.field == &ViewerSettings::errors) errors_ = box;
}

void ViewPanel::offer(const RunContents& contents) {
    for (const auto& [box, entry] : switches_) {
        const std::string why = whyNothingToShow(entry->field, contents);
        box->setEnabled(why.empty());
        box->setTooltip(!why.empty() ? why : withKey(entry->about, entry->key));
    }
}

void ViewPanel::nameErrors(int scale) {
    errors_->setCaption(scale > 1 ? formatted("errors, magnified %d x", scale) : "errors");
}

void ViewPanel::refresh() {
    for (const auto& [box, entry] : switches_) box->setChecked(settings_.*entry->field);
    by_height_->setChecked(settings_.colors == "height");
    point_size_->setValue(static_cast<float>(settings_.point_size_px));
}

PicturePanel::PicturePanel(nanogui::Widget* screen, ViewerSettings& settings,
                           std::function<void()> changed)
    : nanogui::Window(screen, "Images") {
    column(this, 4);
    label_ = new nanogui::Label(this, " ");
    label_->setFixedSize({content_px, line_px});
    color_ = new PictureWidget(this, {content_px, picture_height_px});
    color_->showMarks(settings.features);
    features_ = row(this, 10);
    auto* features = new nanogui::CheckBox(
        features_, "features", [this, &settings, changed = std::move(changed)](bool on) {
            settings.features = on;
            color_->showMarks(on);
            changed();
        });
    features->setChecked(settings.features);
    addLabel(features_, "tracked", tracked_color);
    addLabel(features_, "new", new_color);
    addLabel(features_, "lost", lost_color);
    depth_ = new PictureWidget(this, {content_px, picture_height_px});
    const std::string farthest = std::to_string(cvRound(farthest_painted_m));
    new nanogui::Label(this, "red near, blue " + farthest + " m, black no depth");
}

void PicturePanel::setLive(bool live) {
    features_->setVisible(live);
    if (!live) color_->mark({});
}

PlotPanel::PlotPanel(nanogui::Widget* screen) : nanogui::Window(screen, "Plots") {
    column(this, 4);
    landmarks_ = addPlot("inliers", "");
    times_ = addPlot("frame time", " ms");
    errors_ = addPlot("error", " cm");
}

PlotWidget* PlotPanel::addPlot(const char* title, const char* unit) {
    auto* plot = new PlotWidget(this, {content_px, plot_height_px});
    plot->name(title, unit);
    return plot;
}

void PlotPanel::setCursor(float share) {
    for (PlotWidget* plot : {landmarks_, times_, errors_}) plot->setCursor(share);
}

TimePanel::TimePanel(nanogui::Widget* screen) : nanogui::Window(screen, "") {
    column(this, 2);
    row_ = row(this, 10);
    play_ = new nanogui::Button(row_, "", ENTYPO_ICON_CONTROLLER_PLAY);
    play_->setFlags(nanogui::Button::ToggleButton);
    play_->setTooltip("Replays the run. Key: Space");
    play_->setChangeCallback([this](bool play) { on_play(play); });
    slider_ = new nanogui::Slider(row_);
    slider_->setCallback([this](float share) { on_move(share); });
    time_ = new nanogui::Label(row_, "");
    time_->setFixedSize({110, line_px});
    news_ = new nanogui::Label(this, " ");
}

void TimePanel::fitInto(int width_px) {
    slider_->setFixedWidth(std::max(60, width_px - 200));
    news_->setFixedSize({std::max(100, width_px - 20), line_px});
}

void TimePanel::show(float share, bool playing, const std::string& time) {
    slider_->setValue(share);
    play_->setPushed(playing);
    play_->setIcon(playing ? ENTYPO_ICON_CONTROLLER_PAUS : ENTYPO_ICON_CONTROLLER_PLAY);
    time_->setCaption(time);
}

void TimePanel::setReplayVisible(bool visible) {
    row_->setVisible(visible);
}

HelpPanel::HelpPanel(nanogui::Widget* screen, const std::vector<Shortcut>& shortcuts)
    : nanogui::Window(screen, "Shortcuts") {
    setLayout(new nanogui::GridLayout(nanogui::Orientation::Horizontal, 2,
                                      nanogui::Alignment::Minimum, 12, 3));
    const auto line = [this](const std::string& name, const std::string& meaning) {
        new nanogui::Label(this, name, "sans-bold");
        new nanogui::Label(this, meaning);
    };
    addCloseButton(this, [this] { on_close(); });
    line("left drag", "turn");
    line("right drag", "move");
    line("wheel", "zoom to the pointer");
    line("click", "image of a keyframe, or a point to measure from or to");
    line("double click", "turn around the point clicked");
    for (const Shortcut& shortcut : shortcuts) line(shortcut.name, shortcut.meaning);
}

ExportPanel::ExportPanel(nanogui::Widget* screen) : nanogui::Window(screen, "Write the map") {
    column(this, 6);
    addCloseButton(this, [this] { on_close(); });
    new nanogui::Label(this, "Writes the map as it is shown: without a ceiling");
    new nanogui::Label(this, "that is hidden; in a replay, the map so far.");
    using S = ViewerSettings;
    add("points as PLY", ExportFormat::Ply, &S::points);
    add("points as PCD", ExportFormat::Pcd, &S::points);
    add("mesh as PLY", ExportFormat::Mesh, &S::mesh);
    add("octree with colors as OT", ExportFormat::ColorOctree, &S::octree);
    add("octree, small, as BT", ExportFormat::BinaryOctree, &S::octree);
}

void ExportPanel::add(const char* caption, ExportFormat format, bool ViewerSettings::*needed) {
    auto* button = new nanogui::Button(this, caption);
    button->setCallback([this, format] { on_export(format); });
    buttons_.emplace_back(button, needed);
}

void ExportPanel::offer(const RunContents& contents) {
    for (const auto& [button, needed] : buttons_) {
        const std::string why = whyNothingToShow(needed, contents);
        button->setEnabled(why.empty());
        button->setTooltip(why);
    }
}

HintPanel::HintPanel(nanogui::Widget* screen) : nanogui::Window(screen, "") {
    setLayout(new nanogui::BoxLayout(nanogui::Orientation::Vertical, nanogui::Alignment::Fill, 7));
    label_ = new nanogui::Label(this, " ");
    label_->setFixedWidth(content_px);
    setVisible(false);
}

bool HintPanel::show(const std::string& text) {
    if (text == (visible() ? label_->caption() : std::string())) return false;
    setVisible(!text.empty());
    if (!text.empty()) label_->setCaption(text);
    return true;
}

}  // namespace rgbd_graphslam
