#include "panels.h"

#include <nanogui/entypo.h>

#include <opencv2/core.hpp>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/viewer/keyframe_view.h"
#include "scene_colors.h"

namespace rgbd_graphslam {
namespace {

constexpr int picture_width_px = 288, picture_height_px = 216, plot_width_px = 232,
              plot_height_px = 76, line_px = 18, switch_width_px = 155, switch_height_px = 20,
              swatch_width_px = 18, swatch_height_px = 3;
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

}  // namespace

ViewPanel::ViewPanel(nanogui::Widget* screen, ViewerSettings& settings,
                     std::function<void()> changed)
    : nanogui::Window(screen, "View"), settings_(settings), changed_(std::move(changed)) {
    column(this, 1);
    addSwitch(this, "points", &ViewerSettings::points);
    addSwitch(this, "mesh", &ViewerSettings::mesh);
    addSwitch(this, "octree: occupied", &ViewerSettings::octree);
    addSwitch(this, "octree: free", &ViewerSettings::free_space);
    addSwitch(this, "2-D grid", &ViewerSettings::grid);
    addSwitch("trajectory", &ViewerSettings::trajectory, trajectory_color);
    addSwitch("true trajectory", &ViewerSettings::truth, truth_color);
    errors_ = addSwitch("errors", &ViewerSettings::errors, error_color);
    addSwitch("keyframes", &ViewerSettings::keyframes, keyframe_color);
    addSwitch("covisibility", &ViewerSettings::covisibility, covisibility_color);
    addSwitch("loops", &ViewerSettings::loops, loop_color);
    addSwitch("without loops", &ViewerSettings::before_loops, before_color);
    addSwitch(this, "floor lines", &ViewerSettings::floor);
    addSwitch(this, "cut the ceiling off", &ViewerSettings::cut_ceiling);
    by_height_ = new nanogui::CheckBox(this, "colours by height", [this](bool on) {
        settings_.colors = on ? "height" : "camera";
        changed_();
    });
    new nanogui::Label(this, "point size");
    point_size_ = new nanogui::Slider(this);
    point_size_->setFixedWidth(plot_width_px - 90);
    point_size_->setRange({1, largest_point_px});
    point_size_->setCallback([this](float px) {
        settings_.point_size_px = px;
        changed_();
    });
    refresh();
}

nanogui::CheckBox* ViewPanel::addSwitch(nanogui::Widget* parent, const char* caption,
                                        bool ViewerSettings::*field) {
    auto* box = new nanogui::CheckBox(parent, caption, [this, field](bool on) {
        settings_.*field = on;
        changed_();
    });
    switches_.emplace_back(box, field);
    return box;
}

nanogui::CheckBox* ViewPanel::addSwitch(const char* caption, bool ViewerSettings::*field,
                                        const Rgba& color) {
    nanogui::Widget* line = row(this, 0);
    nanogui::CheckBox* box = addSwitch(line, caption, field);
    box->setFixedSize({switch_width_px, switch_height_px});
    new ColorWidget(line, {swatch_width_px, swatch_height_px}, color);
    return box;
}

void ViewPanel::nameErrors(int scale) {
    errors_->setCaption(scale > 1 ? formatted("errors, %d x longer", scale) : "errors");
}

void ViewPanel::refresh() {
    for (const auto& [box, field] : switches_) box->setChecked(settings_.*field);
    by_height_->setChecked(settings_.colors == "height");
    point_size_->setValue(static_cast<float>(settings_.point_size_px));
}

PicturePanel::PicturePanel(nanogui::Widget* screen, ViewerSettings& settings,
                           std::function<void()> changed)
    : nanogui::Window(screen, "Images") {
    column(this, 4);
    label_ = new nanogui::Label(this, " ");
    label_->setFixedSize({picture_width_px, line_px});
    color_ = new PictureWidget(this, {picture_width_px, picture_height_px});
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
    depth_ = new PictureWidget(this, {picture_width_px, picture_height_px});
    const std::string farthest = std::to_string(cvRound(farthest_painted_m));
    new nanogui::Label(this, "depth: red near, blue " + farthest + " m, black none");
}

void PicturePanel::setLive(bool live) {
    features_->setVisible(live);
    if (!live) color_->mark({});
}

PlotPanel::PlotPanel(nanogui::Widget* screen) : nanogui::Window(screen, "Plots") {
    column(this, 4);
    landmarks_ = addPlot("tracked landmarks", "");
    times_ = addPlot("frame time", " ms");
    errors_ = addPlot("error", " cm");
}

PlotWidget* PlotPanel::addPlot(const char* title, const char* unit) {
    auto* plot = new PlotWidget(this, {plot_width_px, plot_height_px});
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
    line("left drag", "turn");
    line("right drag", "move");
    line("wheel", "zoom to the pointer");
    line("click", "image of a keyframe, or a point to measure from or to");
    line("double click", "turn around the point clicked");
    for (const Shortcut& shortcut : shortcuts) line(shortcut.name, shortcut.meaning);
}

ExportPanel::ExportPanel(nanogui::Widget* screen) : nanogui::Window(screen, "Write the map") {
    column(this, 6);
    new nanogui::Label(this, "What is shown: of a replay the map so far,");
    new nanogui::Label(this, "without the ceiling where it is cut off.");
    const auto add = [this](const char* caption, ExportFormat format) {
        auto* button = new nanogui::Button(this, caption);
        button->setCallback([this, format] { on_export(format); });
    };
    add("points: PLY", ExportFormat::Ply);
    add("points: PCD", ExportFormat::Pcd);
    add("mesh: PLY", ExportFormat::Mesh);
    add("octree with colours: OT", ExportFormat::ColorOctree);
    add("octree, small: BT", ExportFormat::BinaryOctree);
}

}  // namespace rgbd_graphslam
