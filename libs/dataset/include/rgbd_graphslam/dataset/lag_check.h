/** Whether color and depth of a pair were taken at the same time. */
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace rgbd_graphslam {

/** A delay between color and depth. */
struct DepthLag {
    /** Depth shows what color showed so much earlier; negative: what it shows later. */
    double seconds = 0;
    /** The same in frames. */
    int frames = 0;
    /** How well outlines in depth fit color's edges then: standard deviations per frame. */
    double agreement = 0;
};

/** Compares the outlines in some depth images with the edges of the color images up to half a
 *  second before and after. A camera in motion tells which of them fits best; one that stands still
 *  tells nothing. */
class LagCheck {
  public:
    /** \param frames of the recording, all of which are given to add(), in order */
    explicit LagCheck(std::size_t frames);

    /** \param color CV_8UC3 \param depth CV_16UC1 of the same size, 0 = no reading */
    void add(double stamp_s, const cv::Mat& color, const cv::Mat& depth);

    /** Nothing when they are taken together, or when nothing clear can be told. */
    std::optional<DepthLag> finding() const;

  private:
    struct Color {
        double stamp_s = 0;
        cv::Mat1f contrast;
    };
    struct Anchor {
        double stamp_s = 0;
        int width = 0;
        std::vector<Eigen::Vector2f> outlines;
        /** By how many frames earlier color was taken. */
        std::map<int, double> agreements, delays_s;
    };
    bool isAnchor(std::size_t frame) const { return frame % stride_ == stride_ / 2; }
    bool isCompared(std::size_t frame) const;
    void compare(std::size_t anchor, std::size_t color);

    std::size_t stride_, frames_ = 0;
    std::map<std::size_t, Color> colors_;  // of the latest frames
    std::map<std::size_t, Anchor> anchors_;
};

}  // namespace rgbd_graphslam
