/** Whether depth lies where color does. */
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** How depth lies against color. */
struct Misregistration {
    /** Depth is as many times too large about the center of the image: the focal length of the
     *  camera that took it is about `scale` times that of the color camera. */
    double scale = 1;
    /** By how many pixels of the image depth lies right of and below its place, at the center. */
    Eigen::Vector2d shift_px{0, 0};

    /** How well outlines in depth fit color's edges then: standard deviations per frame. */
    double agreement = 0;

    /** Whether a scale other than 1 was found, and not just a shift. */
    bool isScaled() const { return scale != 1; }
};

/** What was found, for a user; without a remedy. \param fx_px focal length of the color camera */
std::string toText(const Misregistration& found, double fx_px);

/** Gathers evidence over some frames of a recording: where depth jumps, color mostly has an edge,
 *  so the scale and shift of depth for which that is most so tell how it lies. Scales from 1/2 to 2
 *  are tried with shifts up to 5 % of the width, and shifts alone up to 12.5 %. */
class RegistrationCheck {
  public:
    /** Takes a frame; one with hardly a jump in depth says nothing and is passed over.
     *  \param color CV_8UC3
     *  \param depth CV_16UC1 of the same size, 0 = no reading */
    void add(const cv::Mat& color, const cv::Mat& depth);

    /** Nothing when depth lies well, when what it is off by is small (3 % of scale, 1.5 % of the
     *  width), or when the frames do not agree. */
    std::optional<Misregistration> finding() const;

  private:
    struct Frame {
        cv::Mat1f coarse, fine;  // contrast of color's edges
        std::vector<Eigen::Vector2f> outlines;
    };
    struct Hypothesis {
        double scale = 1;
        cv::Point2d shift;  // of the reduced image, from depth to color
        double agreement = 0;
    };
    struct Search;
    Search searched() const;
    /** The best near a hypothesis, on the fine images. */
    Hypothesis refined(const Hypothesis& coarse) const;
    bool isClearlyBetter(const Hypothesis& best, const Hypothesis& supposed) const;

    std::vector<Frame> frames_;
    int width_ = 0;
};

}  // namespace rgbd_graphslam
