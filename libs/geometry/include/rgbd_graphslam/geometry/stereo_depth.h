/** Dense depth of rectified stereo pairs. */
#pragma once
#include "rgbd_graphslam/geometry/rgbd_image.h"

namespace rgbd_graphslam {

/** Disparities (px) beyond are not looked for: of surfaces nearer than this, or of more than a
 * third of the image. \param disparity_m_px depth times disparity */
int largestDisparity(int width, double disparity_m_px, double nearest_m = 0.4);

/** Unit (m) in which depth of a stereo camera fits into 16 bits up to a disparity of one pixel. */
double stereoDepthUnit(double disparity_m_px);

/** The pair with the depth of every pixel that semi-global matching (Hirschmueller, "Stereo
 *  processing by semiglobal matching and mutual information", PAMI 2008; `cv::StereoSGBM`) is sure
 *  of: for maps. One thread, the same result everywhere; some 0.1 s.
 *  \param pair with `gray` and `right` */
RgbdImage withDenseDepth(RgbdImage pair);

}  // namespace rgbd_graphslam
