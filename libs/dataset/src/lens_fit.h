/** Lens models of ROS as Brown's. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"

namespace rgbd_graphslam {

/** Sets the camera's distortion to that of a lens.
 *  \param model "plumb_bob"; "rational_polynomial" with k4 to k6 behind; "equidistant" or "fisheye"
 *         (J. Kannala and S. Brandt, PAMI 2006). Empty means plumb_bob
 *  \param coefficients in ROS's and OpenCV's order
 *  \return the largest error of the fit over the image, px; infinite for an unknown model, whose
 *          distortion is left out */
double fitLens(const std::string& model, const std::vector<double>& coefficients, Camera& camera);

}  // namespace rgbd_graphslam
