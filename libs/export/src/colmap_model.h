/** COLMAP's sparse model as text. */
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

struct ColmapFeature {
    Eigen::Vector2d pixel;  // the center of the top-left pixel is (0, 0), as everywhere here
    std::size_t point = 0;  // index
};

struct ColmapImage {
    std::string name;
    SE3 T_world_cam;
    std::vector<ColmapFeature> features;
};

struct ColmapPoint {
    Eigen::Vector3d position;  // m, world
    std::array<std::uint8_t, 3> rgb{};
};

struct ColmapModel {
    Camera camera;  // without distortion
    std::vector<ColmapImage> images;
    std::vector<ColmapPoint> points;
};

/** Texts of cameras.txt, images.txt and points3D.txt; numbers begin with 1. Errors of points are
 *  mean reprojection errors in pixels. */
std::string colmapCameras(const ColmapModel& model);
std::string colmapImages(const ColmapModel& model);
std::string colmapPoints(const ColmapModel& model);

}  // namespace rgbd_graphslam
