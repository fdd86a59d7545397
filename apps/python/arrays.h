/** NumPy arrays as images, and maps as NumPy arrays. */
#pragma once
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <pybind11/numpy.h>

#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/mapping/point_fusion.h"

namespace rgbd_graphslam {

/** \param color uint8, (height, width, 3) BGR as OpenCV reads it, or (height, width) gray
 *  \param depth uint16 in units of 1 / depth_units m, or float32 or float64 in m; (height, width)
 *  \return an image whose color, and depth if uint16, are the arrays' own memory, which it keeps
 *          alive
 *  \throws pybind11::value_error for another shape or type, naming it */
RgbdImage toImage(double stamp_s, const pybind11::array& color, const pybind11::array& depth,
                  double depth_units);

/** (4, 4) */
pybind11::array_t<double> toMatrix(const SE3& pose);
/** (n, 4, 4) */
pybind11::array_t<double> toMatrices(const std::vector<SE3>& poses);

/** \return xyz, float32 (n, 3) in m, and rgb, uint8 (n, 3) */
pybind11::tuple toArrays(const PointMap& points);

/** \return probability that a cell is occupied, float32 (rows along y, columns along x), 0.5 where
 *          nothing is known; x and y of the corner of cell (0, 0) and a cell's edge, m */
pybind11::tuple toArrays(const mrpt::maps::COccupancyGridMap2D& grid);

}  // namespace rgbd_graphslam
