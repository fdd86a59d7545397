#include "scene_overlay.h"

#include <algorithm>
#include <string>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/mapping/height_colors.h"

namespace rgbd_graphslam {
namespace {

constexpr float text_px = 14, margin_px = 18, tick_px = 4, most_bar_px = 150;
constexpr float scale_width_px = 12, scale_height_px = 160;

NVGcolor nvg(const Rgba& color) {
    return nvgRGBA(color[0], color[1], color[2], color[3]);
}

void fill(NVGcontext* context, float x, float y, float width, float height, const Rgba& color) {
    nvgBeginPath(context);
    nvgRect(context, x, y, width, height);
    nvgFillColor(context, nvg(color));
    nvgFill(context);
}

void write(NVGcontext* context, float x, float y, int align, const std::string& text) {
    nvgFontSize(context, text_px);
    nvgFontFace(context, "sans");
    nvgTextAlign(context, align);
    nvgFillColor(context, nvg(background_color));
    nvgText(context, x + 1, y + 1, text.c_str(), nullptr);  // it may lie on the map
    nvgFillColor(context, nvg(label_color));
    nvgText(context, x, y, text.c_str(), nullptr);
}

void drawBar(NVGcontext* context, const SceneOverlay& overlay) {
    const ScaleBar bar = scaleBar(overlay.m_per_px, most_bar_px);
    const auto length = static_cast<float>(bar.length_px);
    const float x = static_cast<float>(overlay.area.x) + margin_px;
    const float y = static_cast<float>(overlay.area.br().y) - margin_px;
    fill(context, x, y - 1, length, 2, label_color);
    fill(context, x, y - tick_px, 2, 2 * tick_px, label_color);
    fill(context, x + length - 2, y - tick_px, 2, 2 * tick_px, label_color);
    write(context, x + length / 2, y - tick_px - 2, NVG_ALIGN_CENTER | NVG_ALIGN_BOTTOM,
          lengthText(bar.length_m));
}

void drawHeights(NVGcontext* context, const SceneOverlay& overlay) {
    const auto [low_m, high_m] = *overlay.heights_m;
    const float x = static_cast<float>(overlay.area.br().x) - margin_px - scale_width_px;
    const float bottom = static_cast<float>(overlay.area.br().y) - margin_px;
    const float step = scale_height_px / height_palette_size;
    for (int i = 0; i < height_palette_size; ++i) {
        const auto& color = heightPalette()[static_cast<std::size_t>(i)];
        fill(context, x, bottom - step * static_cast<float>(i + 1), scale_width_px, step, color);
    }
    constexpr int parts = 4;
    for (int i = 0; i <= parts; ++i) {
        const double height_m = low_m + (high_m - low_m) * i / parts;
        write(context, x - 6, bottom - scale_height_px * static_cast<float>(i) / parts,
              NVG_ALIGN_RIGHT | NVG_ALIGN_MIDDLE, formatted("%.1f m", height_m));
    }
    write(context, x + scale_width_px, bottom - scale_height_px - text_px,
          NVG_ALIGN_RIGHT | NVG_ALIGN_BOTTOM, "height");
}

}  // namespace

void drawSceneOverlay(NVGcontext* context, const SceneOverlay& overlay) {
    const cv::Rect2d bar(overlay.area.x, overlay.area.br().y - 60, most_bar_px + 40, 60);
    for (const SceneLabel& label : overlay.labels) {
        if (bar.contains({label.pixel.x(), label.pixel.y()})) continue;
        write(context, static_cast<float>(label.pixel.x()), static_cast<float>(label.pixel.y()),
              NVG_ALIGN_CENTER | NVG_ALIGN_MIDDLE, label.text);
    }
    drawBar(context, overlay);
    if (overlay.heights_m) drawHeights(context, overlay);
}

}  // namespace rgbd_graphslam
