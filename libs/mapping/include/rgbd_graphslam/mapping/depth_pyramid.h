/** Answers "what does the camera see within this rectangle?" in constant time. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace rgbd_graphslam {

/** Pixels [u0, u1] x [v0, v1], both ends included. */
struct PixelRect {
    int u0, v0, u1, v1;
    double area() const { return (u1 - u0 + 1.) * (v1 - v0 + 1.); }
};

/** Nearest and farthest readings over tiles of growing size (a hierarchical z-buffer: Greene, Kass
 *  and Miller, SIGGRAPH 1993), and the number of readings. */
class DepthPyramid {
  public:
    /** \param depth m, 0 = no reading */
    explicit DepthPyramid(const cv::Mat1f& depth);

    enum class Side {
        Hidden,  // no reading lies behind the nearer depth
        Across,  // neither
        Clear    // all readings lie behind the farther depth
    };
    /** How the depths [near_m, far_m] lie to the readings of a rectangle, or rather of the tiles
     *  that cover it: where those reach farther than it does, the answer can be Across instead. */
    Side sideOf(const PixelRect& rect, float near_m, float far_m) const;

    /** Readings within the rectangle, exactly. \param rect inside the image */
    int readings(const PixelRect& rect) const;

    int width() const { return count_.cols - 1; }
    int height() const { return count_.rows - 1; }
    /** Of the whole image, m. */
    float farthest() const;

  private:
    Side sideAt(std::size_t level, const PixelRect& rect, float near_m, float far_m) const;

    std::vector<cv::Mat2f> levels_;  // (nearest, farthest) of tiles of 2^level pixels
    cv::Mat1i count_;                // summed-area table
};

}  // namespace rgbd_graphslam
