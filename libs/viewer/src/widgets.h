/** Widgets that nanogui lacks. */
#pragma once
#include <nanogui/nanogui.h>

#include <cmath>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "rgbd_graphslam/viewer/marked_picture.h"

namespace rgbd_graphslam {

/** Draws a widget again over what is there, outside of its window's turn.
 *  \param background of labels, which are transparent */
void drawOver(NVGcontext* context, nanogui::Widget& widget, const nanogui::Color& background);

/** A color that stands for something. */
class ColorWidget : public nanogui::Widget {
  public:
    ColorWidget(nanogui::Widget* parent, const nanogui::Vector2i& size_px, const Rgba& color);

    nanogui::Vector2i preferredSize(NVGcontext*) const override { return wanted_px_; }
    void draw(NVGcontext* context) override;

  private:
    nanogui::Vector2i wanted_px_;
    nanogui::Color color_;
};

/** An image with marks. */
class PictureWidget : public nanogui::Widget {
  public:
    PictureWidget(nanogui::Widget* parent, const nanogui::Vector2i& size_px);

    /** \param image BGR; empty shows the text instead */
    void show(const cv::Mat3b& image, const std::string& text_without);
    void mark(std::vector<PictureMark> marks);
    void showMarks(bool show);

    nanogui::Vector2i preferredSize(NVGcontext*) const override { return wanted_px_; }
    void draw(NVGcontext* context) override;

  private:
    void upload(NVGcontext* context);

    nanogui::Vector2i wanted_px_;
    cv::Mat3b image_;
    std::string text_;
    bool is_new_ = false, marks_shown_ = true;
    int handle_ = 0;
    cv::Size uploaded_px_;
    std::vector<PictureMark> marks_;
};

/** A curve over time, from zero on. What is too high for the axis ends at its top. */
class PlotWidget : public nanogui::Widget {
  public:
    PlotWidget(nanogui::Widget* parent, const nanogui::Vector2i& size_px);

    void name(const std::string& title, const std::string& unit);
    /** \param values evenly over the plot's width; NaN leaves a gap */
    void show(const std::vector<float>& values);
    /** \param share of the width where the cursor stands; outside [0, 1] hides it */
    void setCursor(float share) { cursor_ = share; }

    nanogui::Vector2i preferredSize(NVGcontext*) const override { return wanted_px_; }
    void draw(NVGcontext* context) override;

  private:
    void drawCurve(NVGcontext* context);
    void drawCursor(NVGcontext* context);
    void drawTexts(NVGcontext* context);
    /** The value at the cursor, or the last one. */
    float present() const;
    std::string number(float value) const;

    nanogui::Vector2i wanted_px_;
    std::string title_, unit_;
    std::vector<float> values_, curve_;  // all, and what is drawn of them
    float highest_ = 0, axis_end_ = 0;
    float cursor_ = -1;
};

}  // namespace rgbd_graphslam
