/** Brushes that the painters share. In all of this library each random number is drawn in a
 * statement of its own or within braces: C++ leaves it open which argument of a call is worked out
 * first, and a scene must not depend on the compiler. */
#pragma once
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/synth/random.h"
#include "rgbd_graphslam/synth/textures.h"

namespace rgbd_graphslam::synth {

/** Any pixel of a picture of this size. */
cv::Point anyPixel(cv::Size size, Random& random);

/** A plain picture. */
cv::Mat canvas(cv::Size size, const Bgr& color);

/** Adds `strength` gray levels times the field (CV_32FC1) to all channels. */
void addRelief(cv::Mat& picture, const cv::Mat& field, double strength);

Bgr scaled(const Bgr& color, double factor);

/** Lines of made-up letters with words, indents and ragged ends, filling a rectangle.
 *  \param line_px height of a line of text with its gap */
void writeText(cv::Mat& picture, const cv::Rect& box, int line_px, const Bgr& ink, Random& random);

/** Two to five random overlapping discs, bars, rings and polygons. */
void drawShapes(cv::Mat& picture, const cv::Rect& box, int count, Random& random);

/** A landscape out of noise: looks like a print of a photograph. */
void drawPicture(cv::Mat& picture, const cv::Rect& box, Random& random);

/** A diagram with axes and a few curves or bars. */
void drawChart(cv::Mat& picture, const cv::Rect& box, Random& random);

}  // namespace rgbd_graphslam::synth
