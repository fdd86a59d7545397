#include "arrays.h"

#include <opencv2/imgproc.hpp>
#include <string>

namespace rgbd_graphslam {
namespace py = pybind11;
namespace {

std::string shapeText(const py::array& array) {
    return py::str(array.attr("shape")).cast<std::string>() + " of " +
           py::str(array.dtype()).cast<std::string>();
}

[[noreturn]] void refuse(const char* what, const py::array& array, const char* wanted) {
    throw py::value_error(std::string(what) + " is " + shapeText(array) + ", not " + wanted);
}

/** The array's memory as a matrix; rows may be padded, pixels not. */
cv::Mat viewOf(const py::array& array, int type) {
    const auto step = static_cast<std::size_t>(array.strides(0));
    return {static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)), type,
            const_cast<void*>(array.data()), step};
}

template <class Number>
bool isImageOf(const py::array& array, py::ssize_t channels) {
    const bool has_shape =
        channels == 1 ? array.ndim() == 2 : array.ndim() == 3 && array.shape(2) == channels;
    const auto pixel = static_cast<py::ssize_t>(sizeof(Number)) * channels;
    return has_shape && py::isinstance<py::array_t<Number>>(array) && array.strides(1) == pixel &&
           array.strides(0) >= array.shape(1) * pixel &&
           (channels == 1 || array.strides(2) == sizeof(Number));
}

cv::Mat depthOf(const py::array& depth, double depth_units) {
    if (isImageOf<std::uint16_t>(depth, 1)) return viewOf(depth, CV_16UC1);
    cv::Mat meters;
    if (isImageOf<float>(depth, 1)) {
        meters = viewOf(depth, CV_32FC1);
    } else if (isImageOf<double>(depth, 1)) {
        meters = viewOf(depth, CV_64FC1);
    } else {
        refuse("depth", depth, "(height, width) of uint16, or of float32 in m, without gaps");
    }
    cv::Mat units, known = meters.clone();
    cv::patchNaNs(known, 0);
    known.convertTo(units, CV_16UC1, depth_units);
    return units;
}

/** Gives the arrays back to Python, from whichever thread is the last to use the image. */
std::shared_ptr<const void> keeping(const py::array& color, const py::array& depth) {
    auto* const arrays = new std::pair<py::array, py::array>(color, depth);
    return {static_cast<const void*>(arrays), [arrays](const void*) {
                const py::gil_scoped_acquire gil;
                delete arrays;
            }};
}

void put(const SE3& pose, double* matrix) {
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> m(matrix);
    m.setIdentity();
    m.topLeftCorner<3, 3>() = pose.R;
    m.topRightCorner<3, 1>() = pose.t;
}

}  // namespace

RgbdImage toImage(double stamp_s, const py::array& color, const py::array& depth,
                  double depth_units) {
    RgbdImage image;
    image.stamp_s = stamp_s;
    image.depth_unit_m = 1 / depth_units;
    if (isImageOf<std::uint8_t>(color, 3)) {
        image.color = viewOf(color, CV_8UC3);
        cv::cvtColor(image.color, image.gray, cv::COLOR_BGR2GRAY);
    } else if (isImageOf<std::uint8_t>(color, 1)) {
        image.gray = viewOf(color, CV_8UC1);
    } else {
        refuse("color", color, "(height, width, 3) or (height, width) of uint8, without gaps");
    }
    image.depth = depthOf(depth, depth_units);
    image.owner = keeping(color, depth);
    return image;
}

py::array_t<double> toMatrix(const SE3& pose) {
    py::array_t<double> matrix({4, 4});
    put(pose, matrix.mutable_data());
    return matrix;
}

py::array_t<double> toMatrices(const std::vector<SE3>& poses) {
    py::array_t<double> matrices({poses.size(), std::size_t{4}, std::size_t{4}});
    for (std::size_t i = 0; i < poses.size(); ++i) put(poses[i], matrices.mutable_data() + 16 * i);
    return matrices;
}

py::tuple toArrays(const PointMap& points) {
    py::array_t<float> xyz({points.size(), std::size_t{3}});
    py::array_t<std::uint8_t> rgb({points.size(), std::size_t{3}});
    auto position = xyz.mutable_unchecked<2>();
    auto color = rgb.mutable_unchecked<2>();
    for (py::ssize_t i = 0; i < position.shape(0); ++i) {
        const MapPoint& point = points[static_cast<std::size_t>(i)];
        for (int k = 0; k < 3; ++k) {
            position(i, k) = point.position[k];
            color(i, k) = point.rgb[static_cast<std::size_t>(k)];
        }
    }
    return py::make_tuple(xyz, rgb);
}

py::tuple toArrays(const mrpt::maps::COccupancyGridMap2D& grid) {
    py::array_t<float> occupied({grid.getSizeY(), grid.getSizeX()});
    auto cells = occupied.mutable_unchecked<2>();
    for (py::ssize_t y = 0; y < cells.shape(0); ++y) {
        for (py::ssize_t x = 0; x < cells.shape(1); ++x)
            cells(y, x) = 1 - grid.getCell(static_cast<int>(x), static_cast<int>(y));
    }
    return py::make_tuple(occupied, py::make_tuple(grid.getXMin(), grid.getYMin()),
                          grid.getResolution());
}

}  // namespace rgbd_graphslam
