/** Residuals of corners as a picture. */
#pragma once
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/calibration/camera_calibration.h"

namespace rgbd_graphslam {

/** One line per corner from where it was seen, magnified so that 95 % are at most 12 pixels long,
 *  red where they are longer; the magnification is written beside. Patterns show that the lens
 * model does not fit; blank parts of the image were not calibrated. \return CV_8UC3 */
cv::Mat residualPicture(const CameraCalibration& calibration);

}  // namespace rgbd_graphslam
