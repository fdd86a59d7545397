/** Whether depth lies where colour does. */
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace rgbd_graphslam {

/** Gathers evidence over some frames of a sequence: where depth jumps, colour mostly has an edge,
 *  and the shift of depth for which that is most so tells how it lies. Shifts up to about 48 pixels
 *  of a 640 pixel wide image are tried. */
class RegistrationCheck {
  public:
    /** Takes a frame; one with hardly a jump in depth says nothing and is passed over.
     *  \param color CV_8UC3
     *  \param depth CV_16UC1 of the same size, 0 = no reading */
    void add(const cv::Mat& color, const cv::Mat& depth);

    /** By how many pixels of the image depth lies right of and below its place in colour. Nothing
     *  when it lies well, when what it is off by is small (1.5 % of the width), or when the frames
     *  do not agree. */
    std::optional<Eigen::Vector2d> misalignment() const;

  private:
    static constexpr int reach = 24;  // pixels of the reduced image
    static constexpr int side = 2 * reach + 1;

    std::size_t frames_ = 0;
    int width_ = 0;
    /** Agreement for each shift in standard deviations, summed over the even and the odd frames. */
    cv::Mat1d agreement_[2] = {cv::Mat1d(side, side, 0.0), cv::Mat1d(side, side, 0.0)};
};

}  // namespace rgbd_graphslam
