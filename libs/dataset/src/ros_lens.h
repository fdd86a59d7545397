/** Lens models by the names that ROS, Kalibr and OpenCV give them. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/lens.h"

namespace rgbd_graphslam {

/** \param model "plumb_bob", "rational_polynomial", "equidistant" and the like, in any case; empty
 * or unknown to us: Brown's model if there are up to five coefficients \param coefficients in
 * OpenCV's order; zeros at the end do not count \return nothing for a lens that no model of ours
 * describes */
std::optional<Lens> lensByRosName(const std::string& model, std::vector<double> coefficients);

}  // namespace rgbd_graphslam
