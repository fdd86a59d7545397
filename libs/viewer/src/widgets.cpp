#include "widgets.h"

#include <nanogui/opengl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "rgbd_graphslam/viewer/plot_curve.h"

namespace rgbd_graphslam {
namespace {

constexpr float margin_px = 4, text_px = 14;

constexpr Rgba paper_rgba = {25, 28, 34, 255};
const nanogui::Color paper(paper_rgba[0], paper_rgba[1], paper_rgba[2], paper_rgba[3]),
    curve_color(90, 200, 250, 255), cursor_color(255, 170, 60, 255), text_color(225, 228, 232, 255);

void fillRectangle(NVGcontext* context, const nanogui::Vector2i& corner,
                   const nanogui::Vector2i& size, const NVGpaint& paint) {
    nvgBeginPath(context);
    nvgRect(context, corner.x(), corner.y(), size.x(), size.y());
    nvgFillPaint(context, paint);
    nvgFill(context);
}

void fillRectangle(NVGcontext* context, const nanogui::Vector2i& corner,
                   const nanogui::Vector2i& size, const nanogui::Color& color) {
    nvgBeginPath(context);
    nvgRect(context, corner.x(), corner.y(), size.x(), size.y());
    nvgFillColor(context, color);
    nvgFill(context);
}

void write(NVGcontext* context, float x, float y, int align, const std::string& text) {
    nvgFontSize(context, text_px);
    nvgFontFace(context, "sans");
    nvgTextAlign(context, align);
    nvgFillColor(context, text_color);
    nvgText(context, x, y, text.c_str(), nullptr);
}

}  // namespace

void drawOver(NVGcontext* context, nanogui::Widget& widget, const nanogui::Color& background) {
    const nanogui::Vector2i origin = widget.parent()->absolutePosition();
    nvgSave(context);
    nvgTranslate(context, static_cast<float>(origin.x()), static_cast<float>(origin.y()));
    nvgScissor(context, static_cast<float>(widget.position().x()),
               static_cast<float>(widget.position().y()), static_cast<float>(widget.width()),
               static_cast<float>(widget.height()));
    const bool is_transparent = dynamic_cast<nanogui::Label*>(&widget) != nullptr;
    if (is_transparent) fillRectangle(context, widget.position(), widget.size(), background);
    widget.draw(context);
    nvgRestore(context);
}

ColorWidget::ColorWidget(nanogui::Widget* parent, const nanogui::Vector2i& size_px,
                         const Rgba& color)
    : nanogui::Widget(parent),
      wanted_px_(size_px),
      color_(color[0], color[1], color[2], color[3]) {}

void ColorWidget::draw(NVGcontext* context) {
    fillRectangle(context, mPos, mSize, color_);
}

PictureWidget::PictureWidget(nanogui::Widget* parent, const nanogui::Vector2i& size_px)
    : nanogui::Widget(parent), wanted_px_(size_px) {}

void PictureWidget::show(const cv::Mat3b& image, const std::string& text_without) {
    text_ = text_without;
    image_ = image;
    is_new_ = true;
}

void PictureWidget::mark(std::vector<PictureMark> marks) {
    marks_ = std::move(marks);
    is_new_ = true;
}

void PictureWidget::showMarks(bool show) {
    marks_shown_ = show;
    is_new_ = true;
}

/** In the window's own pixels, which need no interpolation. */
void PictureWidget::upload(NVGcontext* context) {
    const float scale = screen()->pixelRatio();
    const cv::Size size_px(cvRound(scale * static_cast<float>(mSize.x())),
                           cvRound(scale * static_cast<float>(mSize.y())));
    if (!is_new_ && size_px == uploaded_px_) return;
    is_new_ = false;
    const cv::Mat4b rgba = fittedPicture(image_, marks_shown_ ? marks_ : std::vector<PictureMark>(),
                                         size_px, paper_rgba);
    if (handle_ != 0 && size_px == uploaded_px_) {
        nvgUpdateImage(context, handle_, rgba.data);
        return;
    }
    if (handle_ != 0) nvgDeleteImage(context, handle_);
    handle_ = nvgCreateImageRGBA(context, rgba.cols, rgba.rows, NVG_IMAGE_NEAREST, rgba.data);
    uploaded_px_ = size_px;
}

void PictureWidget::draw(NVGcontext* context) {
    const float w = static_cast<float>(mSize.x()), h = static_cast<float>(mSize.y());
    const float x = static_cast<float>(mPos.x()), y = static_cast<float>(mPos.y());
    if (image_.empty()) {
        fillRectangle(context, mPos, mSize, paper);
        write(context, x + w / 2, y + h / 2, NVG_ALIGN_CENTER | NVG_ALIGN_MIDDLE, text_);
        return;
    }
    upload(context);
    fillRectangle(context, mPos, mSize, nvgImagePattern(context, x, y, w, h, 0, handle_, 1));
}

PlotWidget::PlotWidget(nanogui::Widget* parent, const nanogui::Vector2i& size_px)
    : nanogui::Widget(parent), wanted_px_(size_px) {}

void PlotWidget::show(const std::vector<float>& values) {
    highest_ = 0;
    for (const float value : values) highest_ = std::fmax(highest_, value);  // passes over gaps
    axis_end_ = axisEnd(values);
    curve_ = thinnedCurve(values, 2 * static_cast<std::size_t>(wanted_px_.x()));
    values_ = values;
}

float PlotWidget::present() const {
    if (values_.empty()) return NAN;
    const bool has_cursor = cursor_ >= 0 && cursor_ <= 1;
    const auto last = static_cast<float>(values_.size() - 1);
    return values_[static_cast<std::size_t>(has_cursor ? std::lround(cursor_ * last) : last)];
}

void PlotWidget::name(const std::string& title, const std::string& unit) {
    title_ = title;
    unit_ = unit;
}

std::string PlotWidget::number(float value) const {
    char text[64];
    const char* format = std::abs(value) < 100 ? "%.3g%s" : "%.0f%s";
    std::snprintf(text, sizeof(text), format, static_cast<double>(value), unit_.c_str());
    return text;
}

void PlotWidget::draw(NVGcontext* context) {
    fillRectangle(context, mPos, mSize, paper);
    if (axis_end_ > 0) drawCurve(context);
    drawCursor(context);
    drawTexts(context);
}

void PlotWidget::drawCurve(NVGcontext* context) {
    const float w = static_cast<float>(mSize.x()), x0 = static_cast<float>(mPos.x());
    const float bottom = static_cast<float>(mPos.y() + mSize.y()) - margin_px;
    const float h = static_cast<float>(mSize.y()) - text_px - 2 * margin_px;
    const auto last = static_cast<float>(std::max<std::size_t>(curve_.size(), 2) - 1);
    nvgBeginPath(context);
    bool drawing = false;
    for (std::size_t i = 0; i < curve_.size(); ++i) {
        const float x = x0 + w * static_cast<float>(i) / last;
        const float y = bottom - h * std::min(curve_[i] / axis_end_, 1.f);
        if (std::isnan(curve_[i])) {
            drawing = false;
        } else if (std::exchange(drawing, true)) {
            nvgLineTo(context, x, y);
        } else {
            nvgMoveTo(context, x, y);
        }
    }
    nvgStrokeColor(context, curve_color);
    nvgStrokeWidth(context, 1.2f);
    nvgStroke(context);
}

void PlotWidget::drawCursor(NVGcontext* context) {
    if (cursor_ < 0 || cursor_ > 1) return;
    const int x = mPos.x() + static_cast<int>(cursor_ * static_cast<float>(mSize.x()));
    fillRectangle(context, {x, mPos.y()}, {1, mSize.y()}, cursor_color);
}

void PlotWidget::drawTexts(NVGcontext* context) {
    const float left = static_cast<float>(mPos.x()) + margin_px;
    const float right = static_cast<float>(mPos.x() + mSize.x()) - margin_px;
    const float top = static_cast<float>(mPos.y()) + 2;
    write(context, left, top, NVG_ALIGN_LEFT | NVG_ALIGN_TOP, title_);
    if (highest_ <= 0) return;
    std::string text = "max " + number(highest_);
    if (std::isfinite(present())) text = number(present()) + ", " + text;
    write(context, right, top, NVG_ALIGN_RIGHT | NVG_ALIGN_TOP, text);
}

}  // namespace rgbd_graphslam
