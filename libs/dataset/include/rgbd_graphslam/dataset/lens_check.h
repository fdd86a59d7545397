/** Whether straight edges look straight through the calibrated lens. */
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/camera_model.h"

namespace rgbd_graphslam {

/** Distortion that the calibration leaves in the images. */
struct LensDistortion {
    /** First radial coefficient, as OpenCV defines k1, of what is left. */
    double k1 = 0;
    double k1_sigma = 0;
    /** By how many pixels it moves the middle of the left and right border outwards. */
    double border_px = 0;
};

/** What was found, for a user; without a remedy. */
std::string toText(const LensDistortion& found);

/** Plumb line method (Brown, "Close-range camera calibration", 1971): lines of the scene bend about
 *  the principal point where a lens is left out or is not that of the calibration. Edges that are
 *  nearly straight are taken for lines; each votes for the coefficient that makes it straightest.
 *  Which edges are curves of the scene need not be known, since those bend to all sides. */
class LensCheck {
  public:
    /** \param camera calibration of the images, with what is known of the lens */
    explicit LensCheck(const CameraModel& camera);

    /** \param color CV_8UC3 or CV_8UC1, of the size of the calibration; others are passed over, as
     *  are a fisheye's, in which no line is straight */
    void add(const cv::Mat& color);

    /** Nothing when edges are straight to within 1 % of the width, or when too few edges or frames
     *  were seen to tell. */
    std::optional<LensDistortion> finding() const;

    /** The estimate that finding() judges; nothing without edges. */
    std::optional<LensDistortion> estimate() const;

    /** Coefficients that are tried: -reach to reach. */
    static constexpr double reach = 0.5, step = 0.02;
    static constexpr int tried = 51;
    /** A number for each of them. */
    using Curve = Eigen::Array<double, tried, 1>;

  private:
    /** Edges of about the same direction and place in the image. */
    struct Bin {
        Curve costs = Curve::Zero(), straight = Curve::Zero();  // weighted by lengths
        double length_px = 0;
    };
    /** Costs of each bin; edges seen in many frames count by the square root of their number. */
    std::vector<Curve> votes() const;
    /** Share of edges, weighted likewise, that are straight for the nearest coefficient tried. */
    double straightShare(double k1) const;

    CameraModel camera_;
    std::vector<Bin> bins_;
    std::size_t frames_ = 0;
};

}  // namespace rgbd_graphslam
